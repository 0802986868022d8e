// The layer of the attractor's flow: an arrow a place, and a dot where the arrows end short of the goal.

import type { Palette } from '../../ui/palette';
import type { FlowField, SeenMessage } from '../../net/protocol.gen';
import { pxFromWorld, type Vec2, type View } from '../../plan/transform';
import { seenAt } from '../observed/observed';
import { flowArrows, flowTraps, type Arrow } from './flow';

/** Head of an arrow: of its length, and not more. */
const HEAD = 0.4;
const MOST_HEAD_PX = 4.5;
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

export function arrowPath(view: View, arrows: readonly Arrow[]): Path2D {
  const path = new Path2D();
  for (const { from_m, to_m } of arrows) {
    const [from, [x, y]] = [pxFromWorld(view, from_m), pxFromWorld(view, to_m)];
    const [dx, dy] = [x - from[0], y - from[1]];
    const length = Math.hypot(dx, dy);
    const head = Math.min(MOST_HEAD_PX, HEAD * length) / length;
    path.moveTo(...from);
    path.lineTo(x, y);
    path.moveTo(x - head * (dx - 0.6 * dy), y - head * (dy + 0.6 * dx));
    path.lineTo(x, y);
    path.lineTo(x - head * (dx + 0.6 * dy), y - head * (dy - 0.6 * dx));
  }
  return path;
}

export function drawFlow(
  ctx: CanvasRenderingContext2D,
  view: View,
  palette: Palette,
  flow: Flow,
): void {
  ctx.strokeStyle = palette.flow;
  ctx.lineWidth = 1.1;
  for (const isSeen of [true, false]) {
    ctx.globalAlpha = isSeen ? 1 : UNSEEN_ALPHA;
    const arrows = flow.arrows.filter((arrow) => arrow.isSeen === isSeen);
    ctx.stroke(arrowPath(view, arrows));
  }
  ctx.globalAlpha = 1;
  ctx.fillStyle = palette.danger;
  ctx.strokeStyle = palette.floor;
  ctx.lineWidth = 1.5;
  for (const trap of flow.traps) {
    ctx.beginPath();
    ctx.arc(...pxFromWorld(view, trap), TRAP_PX, 0, 2 * Math.PI);
    ctx.fill();
    ctx.stroke();
  }
}
