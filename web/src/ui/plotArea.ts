// Drawing over a plot, no farther than its axes.

import type uPlot from 'uplot';

/** `ratio` is canvas pixels a CSS pixel. */
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
