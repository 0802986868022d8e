import { pxFromWorld, type View } from './transform';
import type { Ctx } from './sheet';

/** On a canvas a thousand pixels wide, more points would not be visible. */
const POINTS = 4000;

/** Coordinates are oldest first. */
export function drawTrail(
  ctx: Ctx,
  view: View,
  color: string,
  xs_m: Float64Array,
  ys_m: Float64Array,
): void {
  const last = xs_m.length - 1;
  const stride = Math.max(1, Math.floor(xs_m.length / POINTS));
  ctx.beginPath();
  // Always the same points, so that the line does not flicker, and the newest one.
  for (let i = 0; i < last; i += stride) {
    ctx.lineTo(...pxFromWorld(view, [xs_m[i] ?? 0, ys_m[i] ?? 0]));
  }
  if (last >= 0) ctx.lineTo(...pxFromWorld(view, [xs_m[last] ?? 0, ys_m[last] ?? 0]));
  ctx.strokeStyle = color;
  ctx.lineWidth = 1.5;
  ctx.lineJoin = 'round';
  ctx.globalAlpha = 0.6;
  ctx.stroke();
  ctx.globalAlpha = 1;
}
