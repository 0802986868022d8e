// Draws over a plot, clipped to its axes.

import type uPlot from 'uplot';

/** `ratio` is canvas pixels per CSS pixel. */
export function inside(
  u: uPlot,
  draw: (ctx: CanvasRenderingContext2D, ratio: number) => void,
): void {
  const { ctx, bbox } = u;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  draw(ctx, window.devicePixelRatio);
  ctx.restore();
}
