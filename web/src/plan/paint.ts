// Draws one frame of the plan view.

import type { DragState } from './drag';
import type { History } from '../lab/history';
import type { MovedWalls } from '../lab/movedWalls';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import { type BaseMap, drawClipped, paintBaseMap } from './baseMap';
import { drawCursor, drawSpring } from './drawHand';
import { drawBead, drawGoal, drawSteering, drawTool } from './drawMoving';
import { drawFog } from './fog';
import type { Draw, MovingPicture } from './layer';
import { clampToRect, type Vec2 } from '../lab/geometry';

export interface Picture {
  readonly map: BaseMap;
  /** The walls where they are now; undefined while they are at rest. */
  readonly walls: MovedWalls | undefined;
  /** Parts of the layers that are drawn with every state. */
  readonly moving: readonly Draw<MovingPicture>[];
  readonly state: StateMessage | undefined;
  readonly history: History;
  readonly drag: DragState;
  /** Radius of the ring that shows that the bead can be grabbed; undefined if it cannot. */
  readonly grabRadiusPx: number | undefined;
  readonly cursor: Vec2 | undefined;
  /** Where the hand points the tool. */
  readonly steer_m: Vec2 | undefined;
  /** Covers what the camera has not seen; the bead is then drawn where the tracker reports it. */
  readonly fog: Path2D | undefined;
}

type Ctx = CanvasRenderingContext2D;

/** Remarks about a hold: that the bead is lifted, or when it moves while paused. */
export function remarkOf(drag: DragState, state: StateMessage): string {
  const remarks: string[] = [];
  if (drag.kind === 'held' && drag.lift) remarks.push('lifted');
  if (!state.running) remarks.push('moves there on release');
  return remarks.join(', ');
}

/** The hand's place: the own pointer is newer than the server's echo of it; a viewer sees the echo. */
export function handOf(
  drag: DragState,
  state: StateMessage,
  scene: SceneMessage,
): Vec2 | undefined {
  return drag.kind === 'held' ? clampToRect(scene.workspace, drag.at) : (state.hand_m ?? undefined);
}

/** The bead where the tracker reports it. */
function asTracked(state: StateMessage): StateMessage {
  const [x, y] = state.bead_tracked_m;
  return { ...state, bead_m: [x, y, state.bead_m[2]] };
}

function paintSpring(ctx: Ctx, picture: Picture, state: StateMessage, widthPx: number): void {
  const { drag } = picture;
  const { view, palette, scene } = picture.map;
  const hand_m = handOf(drag, state, scene);
  if (!hand_m) return;
  drawSpring(ctx, view, palette, widthPx, {
    bead_m: [state.bead_m[0], state.bead_m[1]],
    hand_m,
    force_n: state.hand_force_n,
    remark: remarkOf(drag, state),
  });
}

function paintState(ctx: Ctx, picture: Picture, state: StateMessage, widthPx: number): void {
  const { view, palette, scene } = picture.map;
  const tool: Vec2 = [state.tool_m[0], state.tool_m[1]];
  const moving = { view, palette, scene, state, history: picture.history };
  for (const draw of picture.moving) drawClipped(ctx, moving, draw);
  if (state.goal_m) drawGoal(ctx, view, palette, [state.goal_m[0], state.goal_m[1]]);
  if (picture.steer_m) drawSteering(ctx, view, palette, tool, picture.steer_m);
  drawTool(ctx, view, palette, tool);
  const shown = picture.fog ? asTracked(state) : state;
  drawBead(ctx, view, palette, scene, shown, picture.grabRadiusPx);
  paintSpring(ctx, picture, state, widthPx);
}

export function paint(
  canvas: HTMLCanvasElement,
  size: { readonly width: number; readonly height: number },
  picture: Picture,
  ratio = window.devicePixelRatio,
): void {
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
  paintBaseMap(ctx, picture.map, picture.walls);
  if (picture.fog) drawFog(ctx, picture.map, picture.fog);
  if (picture.state) paintState(ctx, picture, picture.state, size.width);
  if (picture.cursor) drawCursor(ctx, picture.map.view, picture.map.palette, picture.cursor);
}
