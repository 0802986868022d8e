import { pxFromWorld, type View } from './transform';

/** On a canvas a thousand pixels wide, more points would not be visible. */
const POINTS = 800;

/** Coordinates are oldest first. */
export function drawTrail(
  ctx: CanvasRenderingContext2D,
  view: View,
  color: string,
  xs_m: Float64Array,
  ys_m: Float64Array,
): void {
  const stride = Math.max(1, Math.floor(xs_m.length / POINTS));
  ctx.beginPath();
  for (let i = xs_m.length - 1; i >= 0; i -= stride) {
    ctx.lineTo(...pxFromWorld(view, [xs_m[i] ?? 0, ys_m[i] ?? 0]));
  }
  ctx.strokeStyle = color;
  ctx.lineWidth = 1.5;
  ctx.lineJoin = 'round';
  ctx.globalAlpha = 0.6;
  ctx.stroke();
  ctx.globalAlpha = 1;
}
