// Paths of small marks, in pixels.

import type { Vec2 } from '../lab/geometry';
import type { Ctx } from './sheet';

export function circle(ctx: Ctx, [x, y]: Vec2, radius: number): void {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
}

/** Four lines to the sides, around a free middle. */
export function cross(ctx: Ctx, [x, y]: Vec2, to: number, from = 0): void {
  ctx.beginPath();
  for (const side of [-1, 1]) {
    ctx.moveTo(x + side * from, y);
    ctx.lineTo(x + side * to, y);
    ctx.moveTo(x, y + side * from);
    ctx.lineTo(x, y + side * to);
  }
}
