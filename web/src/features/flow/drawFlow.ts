// Draws the attractor flow: one arrow per place, and a dot where the flow ends before the goal.

import type { FlowField, SeenMessage } from '../../net/protocol.gen';
import type { BasePicture } from '../../plan/layer';
import { strokeCased } from '../../plan/marks';
import { circle } from '../../plan/shapes';
import { pxFromWorld } from '../../plan/transform';
import { type Arrow, arrowPath } from '../../plan/arrows';
import { flowArrows, flowTraps } from './flow';
import type { Vec2 } from '../../lab/geometry';
import { seenAt } from '../../lab/obstacleMap';
import type { Ctx } from '../../plan/sheet';

const TRAP_PX = 4.5;
const UNSEEN_ALPHA = 0.5;

export interface Flow {
  readonly arrows: readonly Arrow[];
  readonly traps: readonly Vec2[];
}

export function createFlow(field: FlowField, goal_m: Vec2, seen: SeenMessage): Flow {
  const isSeen = seenAt(seen);
  return { arrows: flowArrows(field, isSeen), traps: flowTraps(field, goal_m, isSeen) };
}

export function drawFlow(ctx: Ctx, { view, palette }: BasePicture, flow: Flow): void {
  ctx.strokeStyle = palette['m-attractor'];
  ctx.lineWidth = 1.4;
  for (const isSeen of [true, false]) {
    ctx.globalAlpha = isSeen ? 1 : UNSEEN_ALPHA;
    const arrows = flow.arrows.filter((arrow) => arrow.isSeen === isSeen);
    ctx.stroke(arrowPath(view, arrows));
  }
  ctx.globalAlpha = 1;
  ctx.fillStyle = palette['m-danger'];
  for (const trap of flow.traps) {
    circle(ctx, pxFromWorld(view, trap), TRAP_PX);
    strokeCased(ctx, palette, { colour: palette['m-danger'], width_px: 1 });
    ctx.fill();
  }
}
