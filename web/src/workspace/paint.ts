// One picture of the workspace, from everything that is on it.

import type { DragState } from '../drag';
import type { History } from '../history';
import type { Palette } from '../palette';
import type {
  ComparisonMessage,
  OverlayMessage,
  SceneMessage,
  StateMessage,
} from '../protocol.gen';
import { clampToRect, pxFromWorld, worldFromPx, type Vec2, type View } from '../transform';
import { drawFlow, type Flow } from './drawFlow';
import { drawGhosts } from './drawGhosts';
import { drawCursor, drawSpring } from './drawHand';
import { drawHeat, type Heat } from './drawHeat';
import { drawFloor, drawMap } from './drawMap';
import { drawObstacles, drawPlan, type Plan } from './drawPlan';
import { drawValues, type Values } from './drawValue';
import { drawBlocks, drawRectangles, drawSeen, type Seen } from './drawSeen';
import {
  drawBead,
  drawCapture,
  drawFootprint,
  drawGoal,
  drawSensed,
  drawTool,
  drawTrail,
} from './drawMoving';
import type { Layer } from './layers';

const TRAIL_S = 60;

export interface Picture {
  readonly view: View;
  readonly palette: Palette;
  readonly scene: SceneMessage;
  readonly walls: Path2D;
  readonly state: StateMessage | undefined;
  readonly overlay: OverlayMessage | undefined;
  /** The layer of singularities, when it is shown. */
  readonly heat: Heat | undefined;
  /** What the policy thinks of each place, when it is shown. */
  readonly values: Values | undefined;
  /** What the camera has shown, when it is shown. */
  readonly seen: Seen | undefined;
  /** What ERRT plans, when it does. */
  readonly plan: Plan | undefined;
  /** The attractor's flow, when it is shown. */
  readonly flow: Flow | undefined;
  /** A fork, and the tick at which its branches are shown. */
  readonly ghosts: { readonly comparison: ComparisonMessage; readonly tick: number } | undefined;
  readonly history: History;
  readonly layers: ReadonlySet<Layer>;
  readonly drag: DragState;
  /** Radius of the ring that says that the bead can be taken; none when it cannot. */
  readonly grabRadiusPx: number | undefined;
  readonly cursor: Vec2 | undefined;
}

type Ctx = CanvasRenderingContext2D;

function paintTrails(ctx: Ctx, picture: Picture, state: StateMessage): void {
  const [toolX, toolY, beadX, beadY] = picture.history.window(
    state.sim_time_s - TRAIL_S,
    state.sim_time_s,
    ['tool_x_m', 'tool_y_m', 'bead_x_m', 'bead_y_m'],
  );
  if (!toolX || !toolY || !beadX || !beadY) return;
  drawTrail(ctx, picture.view, picture.palette.tool, toolX, toolY);
  drawTrail(ctx, picture.view, picture.palette.bead, beadX, beadY);
}

function paintSpring(ctx: Ctx, picture: Picture, state: StateMessage, widthPx: number): void {
  const { drag, view, scene } = picture;
  // One's own pointer is newer than the server's echo of it; a viewer sees the echo.
  const hand_m =
    drag.kind === 'held' ? clampToRect(scene.workspace, worldFromPx(view, drag.at)) : state.hand_m;
  if (!hand_m) return;
  const remarks: string[] = [];
  if (drag.kind === 'held' && drag.lift) remarks.push('lifted');
  if (!state.running) remarks.push('put there on release');
  drawSpring(ctx, view, picture.palette, widthPx, {
    bead_m: [state.bead_m[0], state.bead_m[1]],
    hand_m,
    force_n: state.hand_force_n,
    remark: remarks.join(', '),
  });
}

/** Fields reach beyond the table; their pictures would cover the numbers of the axes. */
function clipToWorkspace(ctx: Ctx, { view, scene }: Picture): void {
  const rect = scene.workspace;
  const [left, top] = pxFromWorld(view, [rect.x_min_m, rect.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [rect.x_max_m, rect.y_min_m]);
  ctx.beginPath();
  ctx.rect(left, top, right - left, bottom - top);
  ctx.clip();
}

function paintState(ctx: Ctx, picture: Picture, state: StateMessage, widthPx: number): void {
  const { view, palette, scene, layers } = picture;
  const tool: Vec2 = [state.tool_m[0], state.tool_m[1]];
  ctx.save();
  clipToWorkspace(ctx, picture);
  if (picture.overlay) {
    if (layers.has('blocks')) drawBlocks(ctx, view, palette, picture.overlay.blocks);
    if (layers.has('rectangles')) drawRectangles(ctx, view, palette, picture.overlay.blocks);
    if (layers.has('sensed')) drawSensed(ctx, view, palette, picture.overlay);
  }
  if (picture.plan) {
    if (layers.has('obstacles')) drawObstacles(ctx, palette, picture.plan);
    if (layers.has('plan')) drawPlan(ctx, palette, picture.plan);
  }
  if (layers.has('trail')) paintTrails(ctx, picture, state);
  if (layers.has('camera')) drawFootprint(ctx, view, palette, tool, scene.camera_sees_m);
  if (layers.has('capture')) {
    drawCapture(ctx, view, palette, tool, scene.capture_m);
  }
  ctx.restore();
  if (state.goal_m) drawGoal(ctx, view, palette, [state.goal_m[0], state.goal_m[1]]);
  if (picture.ghosts) {
    drawGhosts(ctx, view, palette, picture.ghosts.comparison, picture.ghosts.tick);
  }
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
  drawFloor(ctx, picture.scene.workspace, picture.view, picture.palette);
  if (picture.heat) {
    ctx.save();
    clipToWorkspace(ctx, picture);
    drawHeat(ctx, picture.view, picture.palette, picture.heat);
    ctx.restore();
  }
  if (picture.values) {
    ctx.save();
    clipToWorkspace(ctx, picture);
    drawValues(ctx, picture.view, picture.palette, picture.values);
    ctx.restore();
  }
  drawMap(ctx, picture.scene, picture.walls, picture.view, picture.palette);
  if (picture.seen) drawSeen(ctx, picture.view, picture.seen);
  if (picture.flow) {
    ctx.save();
    clipToWorkspace(ctx, picture);
    drawFlow(ctx, picture.view, picture.palette, picture.flow);
    ctx.restore();
  }
  if (picture.state) paintState(ctx, picture, picture.state, size.width);
  if (picture.cursor) drawCursor(ctx, picture.view, picture.palette, picture.cursor);
}
