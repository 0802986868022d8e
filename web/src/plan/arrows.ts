// Arrows on the table.

import type { Vec2 } from '../lab/geometry';
import { pxFromWorld, type View } from './transform';

/** Size of an arrow's head: a share of its length, up to a maximum. */
const HEAD = 0.4;
const MAX_HEAD_PX = 4.5;

export interface Arrow {
  readonly from_m: Vec2;
  readonly to_m: Vec2;
  /** Whether the camera has shown the place; otherwise the arrow is faint. */
  readonly isSeen: boolean;
}

export function arrowPath(view: View, arrows: readonly Arrow[]): Path2D {
  const path = new Path2D();
  for (const { from_m, to_m } of arrows) {
    const [from, [x, y]] = [pxFromWorld(view, from_m), pxFromWorld(view, to_m)];
    const [dx, dy] = [x - from[0], y - from[1]];
    const length = Math.hypot(dx, dy);
    const head = Math.min(MAX_HEAD_PX, HEAD * length) / length;
    path.moveTo(...from);
    path.lineTo(x, y);
    path.moveTo(x - head * (dx - 0.6 * dy), y - head * (dy + 0.6 * dx));
    path.lineTo(x, y);
    path.lineTo(x - head * (dx + 0.6 * dy), y - head * (dy - 0.6 * dx));
  }
  return path;
}
