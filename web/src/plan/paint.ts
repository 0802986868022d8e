// One picture of the workspace, from everything that is on it.

import type { DragState } from './drag';
import type { History } from '../lab/history';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import { planView, pxFromWorld } from './transform';
import { drawFlow } from '../features/flow/drawFlow';
import { drawGhosts } from '../features/compare/drawGhosts';
import { drawCursor, drawSpring } from './drawHand';
import { drawHeat } from '../features/singularity/drawHeat';
import { drawFloor, drawMap } from './drawMap';
import {
  drawBead,
  drawCapture,
  drawFootprint,
  drawGoal,
  drawSensed,
  drawTool,
  drawTrail,
} from './drawMoving';
import { drawObstacles, drawPlan } from '../features/planner/drawPlan';
import { drawField } from '../features/field/drawPlane';
import { drawBlocks, drawRectangles, drawSeen } from '../features/observed/drawObserved';
import { drawValues } from '../features/values/drawValue';
import type { Ground } from './baseMap';
import { clampToRect, type TableView, type Vec2 } from '../lab/geometry';

/** As long as the plots show. */
export const TRAIL_S = 60;

export interface Picture {
  readonly ground: Ground;
  readonly state: StateMessage | undefined;
  readonly history: History;
  readonly drag: DragState;
  /** Radius of the ring that says that the bead can be taken; none when it cannot. */
  readonly grabRadiusPx: number | undefined;
  readonly cursor: Vec2 | undefined;
}

type Ctx = CanvasRenderingContext2D;

function paintTrails(ctx: Ctx, { ground, history }: Picture, state: StateMessage): void {
  const [toolX, toolY, beadX, beadY] = history.window(
    state.sim_time_s - TRAIL_S,
    state.sim_time_s,
    ['tool_x_m', 'tool_y_m', 'bead_x_m', 'bead_y_m'],
  );
  if (!toolX || !toolY || !beadX || !beadY) return;
  drawTrail(ctx, ground.view, ground.palette.tool, toolX, toolY);
  drawTrail(ctx, ground.view, ground.palette.bead, beadX, beadY);
}

/** What is worth knowing about a hold: that the bead is lifted, or, while time stands, when it moves. */
export function remarkOf(drag: DragState, state: StateMessage): string {
  const remarks: string[] = [];
  if (drag.kind === 'held' && drag.lift) remarks.push('lifted');
  if (!state.running) remarks.push('put there on release');
  return remarks.join(', ');
}

/** Where the hand is: one's own pointer is newer than the server's echo of it; a viewer sees the echo. */
export function handOf(
  drag: DragState,
  state: StateMessage,
  scene: SceneMessage,
  toWorld: TableView['toWorld'],
): Vec2 | undefined {
  const own = drag.kind === 'held' ? toWorld(drag.at) : undefined;
  return own ? clampToRect(scene.workspace, own) : (state.hand_m ?? undefined);
}

function paintSpring(ctx: Ctx, picture: Picture, state: StateMessage, widthPx: number): void {
  const { drag } = picture;
  const { view, palette, scene } = picture.ground;
  const hand_m = handOf(drag, state, scene, planView(view).toWorld);
  if (!hand_m) return;
  drawSpring(ctx, view, palette, widthPx, {
    bead_m: [state.bead_m[0], state.bead_m[1]],
    hand_m,
    force_n: state.hand_force_n,
    remark: remarkOf(drag, state),
  });
}

/** Fields reach beyond the table; their pictures would cover the numbers of the axes. */
function clipped(ctx: Ctx, { view, scene }: Ground, draw: () => void): void {
  const rect = scene.workspace;
  const [left, top] = pxFromWorld(view, [rect.x_min_m, rect.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [rect.x_max_m, rect.y_min_m]);
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, right - left, bottom - top);
  ctx.clip();
  draw();
  ctx.restore();
}

/** Everything that lies on the table, from the floor up. */
export function paintGround(ctx: Ctx, ground: Ground): void {
  const { view, palette, scene, layers, overlay, heat, values, seen, plan, flow, ghosts } = ground;
  drawFloor(ctx, scene.workspace, view, palette);
  clipped(ctx, ground, () => {
    if (heat) drawHeat(ctx, view, palette, heat);
    if (values) drawValues(ctx, view, palette, values);
  });
  drawMap(ctx, scene, ground.walls, view, palette);
  if (seen) drawSeen(ctx, view, seen);
  clipped(ctx, ground, () => {
    if (flow) drawFlow(ctx, view, palette, flow);
    if (overlay) {
      if (layers.has('blocks')) drawBlocks(ctx, view, palette, overlay.blocks);
      if (layers.has('rectangles')) drawRectangles(ctx, view, palette, overlay.blocks);
      if (layers.has('sensed')) drawSensed(ctx, view, palette, overlay);
    }
    if (plan) {
      if (layers.has('obstacles')) drawObstacles(ctx, palette, plan);
      if (layers.has('plan')) drawPlan(ctx, palette, plan);
    }
  });
  if (ghosts) drawGhosts(ctx, view, palette, ghosts.comparison, ghosts.tick);
}

function paintState(ctx: Ctx, picture: Picture, state: StateMessage, widthPx: number): void {
  const { view, palette, scene, layers, field } = picture.ground;
  const tool: Vec2 = [state.tool_m[0], state.tool_m[1]];
  clipped(ctx, picture.ground, () => {
    if (field) drawField(ctx, view, palette, tool, field);
    if (layers.has('trail')) paintTrails(ctx, picture, state);
    if (layers.has('camera')) drawFootprint(ctx, view, palette, tool, scene.camera_sees_m);
    if (layers.has('capture')) drawCapture(ctx, view, palette, tool, scene.capture_m);
  });
  if (state.goal_m) drawGoal(ctx, view, palette, [state.goal_m[0], state.goal_m[1]]);
  drawTool(ctx, view, palette, tool);
  drawBead(ctx, view, palette, scene, state, picture.grabRadiusPx);
  paintSpring(ctx, picture, state, widthPx);
}

export function paint(
  canvas: HTMLCanvasElement,
  size: { readonly width: number; readonly height: number },
  picture: Picture,
): void {
  const ratio = window.devicePixelRatio;
  const width = Math.round(size.width * ratio);
  const height = Math.round(size.height * ratio);
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const ctx = canvas.getContext('2d');
  if (!ctx) return;
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, size.width, size.height);
  paintGround(ctx, picture.ground);
  if (picture.state) paintState(ctx, picture, picture.state, size.width);
  if (picture.cursor) drawCursor(ctx, picture.ground.view, picture.ground.palette, picture.cursor);
}
