// Draws one frame of the plan view.

import type { History } from '../lab/history';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import { type BaseMap, type Ground, clipped, paintAbove, paintGround } from './baseMap';
import { drawCursor, drawPull } from './drawHand';
import {
  drawBead,
  drawGoal,
  drawGrabRing,
  drawStart,
  drawSteering,
  drawTool,
  drawTracked,
} from './drawMoving';
import { drawFog } from './fog';
import type { Act } from './gesture';
import type { Draw, MovingPicture } from './layer';
import { type Ctx, contextOf, Sheet } from './sheet';
import type { Size } from '../ui/size';
import { clampToRect, distance, type Vec2 } from '../lab/geometry';
import { centimetres, newtons } from '../ui/format';

/** What does not change with every state. */
export interface Base extends BaseMap {
  /** Covers what the camera has not seen; the bead is then drawn where the tracker reports it. */
  readonly fog: HTMLCanvasElement | undefined;
}

export interface Picture {
  readonly base: Base;
  /** Parts of the layers that are drawn with every state. */
  readonly moving: readonly Draw<MovingPicture>[];
  readonly state: StateMessage | undefined;
  readonly history: History;
  readonly act: Act;
  /** Whether the bead can be taken, and whether a press would do so now. */
  readonly grab: { readonly isNear: boolean } | undefined;
  readonly cursor: Vec2 | undefined;
  /** Where the hand points the tool. */
  readonly steer_m: Vec2 | undefined;
}

/** How the hand pulls the bead. */
export interface Pull {
  readonly hand_m: Vec2;
  readonly isLifted: boolean;
  /** Force, length of the spring, and remarks: that the bead is lifted, or when it moves while paused. */
  readonly words: string;
}

/** The own pointer is newer than the server's echo of it; a viewer sees the echo. */
export function pullOf(act: Act, state: StateMessage, scene: SceneMessage): Pull | undefined {
  const own = act.kind === 'held' ? act : undefined;
  const hand_m = own ? clampToRect(scene.workspace, own.at) : state.hand_m;
  if (!hand_m) return undefined;
  const stretched_m = distance([state.bead_m[0], state.bead_m[1]], hand_m);
  const isLifted = own?.lift ?? false;
  const remarks = [isLifted && 'lifted', !state.running && 'moves there on release'];
  const parts = [newtons(state.hand_force_n), centimetres(stretched_m)];
  const remark = remarks.filter(Boolean).join(', ');
  return { hand_m, isLifted, words: [...parts, ...(remark ? [remark] : [])].join(' · ') };
}

/** Where the bead was at first; undefined if this page has not seen that. */
export function startOf({ scenario }: SceneMessage, history: History): Vec2 | undefined {
  if (scenario.start_m) return scenario.start_m;
  if (history.before(0, 'tick') !== 0) return undefined;
  return [history.before(0, 'bead_x_m'), history.before(0, 'bead_y_m')];
}

function paintState(ctx: Ctx, picture: Picture, state: StateMessage): void {
  const { view, palette, scene, free } = picture.base.ground;
  const { history, grab } = picture;
  const tool: Vec2 = [state.tool_m[0], state.tool_m[1]];
  const bead_m = picture.base.fog ? state.bead_tracked_m : state.bead_m;
  const bead: Vec2 = [bead_m[0], bead_m[1]];
  const moving = { view, palette, scene, free, state, history };
  for (const draw of picture.moving) clipped(draw)(ctx, moving);
  const start = startOf(scene, history);
  if (start) drawStart(ctx, view, palette, start);
  if (state.goal_m) drawGoal(ctx, view, palette, [state.goal_m[0], state.goal_m[1]]);
  if (picture.steer_m) drawSteering(ctx, view, palette, tool, picture.steer_m);
  if (grab) drawGrabRing(ctx, view, palette, bead, grab.isNear);
  drawTool(ctx, view, palette, tool);
  const pull = pullOf(picture.act, state, scene);
  if (pull) drawPull(ctx, view, palette, bead, pull);
  drawBead(ctx, view, palette, bead, scene.bead_radius_m);
  drawTracked(ctx, view, palette, state.bead_tracked_m);
}

function paintCover(ctx: Ctx, base: Base): void {
  paintAbove(ctx, base);
  if (base.fog) clipped(drawFog(base.fog))(ctx, base.ground);
}

/** It keeps what does not change from one picture to the next. */
export function createPainter() {
  const grounds = new Sheet<Ground>(paintGround);
  const bases = new Sheet<Base>((ctx, base, size, ratio) => {
    grounds.copy(ctx, base.ground, size, ratio);
    paintCover(ctx, base);
  });
  return (
    canvas: HTMLCanvasElement,
    size: Size,
    picture: Picture,
    ratio = window.devicePixelRatio,
  ): void => {
    const ctx = contextOf(canvas, size, ratio);
    if (!ctx) return;
    const { base, state, cursor } = picture;
    if (base.ground.moved) {
      // Everything changes with every state: copies would only cost time.
      paintGround(ctx, base.ground);
      paintCover(ctx, base);
    } else bases.copy(ctx, base, size, ratio);
    if (state) paintState(ctx, picture, state);
    if (cursor) drawCursor(ctx, base.ground.view, base.ground.palette, cursor);
  };
}
