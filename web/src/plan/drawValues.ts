// Draws the value layer: one colour per cell, and arrows of the best steps.

import type { Palette } from '../ui/palette';
import { pxFromWorld, type View } from './transform';
import { type ValueCells, valueArrows, valuePicture, type ValuePicture } from './values';
import { arrowPath } from './arrows';
import { heatRamp } from './colourRamp';

export interface Values {
  readonly picture: ValuePicture;
  readonly image: HTMLCanvasElement;
  readonly spacing_m: number;
  readonly arrows: Path2D;
}

/** `range` has the values of the first and the last colour. */
export function createValues(
  map: ValueCells,
  palette: Palette,
  view: View,
  range?: readonly [number, number],
): Values | undefined {
  const picture = valuePicture(map, heatRamp(palette), range);
  if (!picture) return undefined;
  const image = document.createElement('canvas');
  image.width = picture.columns;
  image.height = picture.rows;
  const pixels = new ImageData(picture.pixels, picture.columns, picture.rows);
  image.getContext('2d')?.putImageData(pixels, 0, 0);
  const arrows = arrowPath(view, valueArrows(map, view.pxPerM));
  return { picture, image, spacing_m: map.spacing_m, arrows };
}

export function drawValues(
  ctx: CanvasRenderingContext2D,
  view: View,
  palette: Palette,
  values: Values,
): void {
  drawColours(ctx, view, values);
  drawArrows(ctx, palette, values);
}

export function drawColours(ctx: CanvasRenderingContext2D, view: View, values: Values): void {
  const { corner_m, columns, rows } = values.picture;
  const side = values.spacing_m * view.pxPerM;
  // No smoothing: each cell has its own value.
  ctx.imageSmoothingEnabled = false;
  ctx.drawImage(values.image, ...pxFromWorld(view, corner_m), columns * side, rows * side);
}

export function drawArrows(ctx: CanvasRenderingContext2D, palette: Palette, values: Values): void {
  ctx.strokeStyle = palette.text;
  ctx.lineWidth = 1;
  ctx.globalAlpha = 0.55;
  ctx.stroke(values.arrows);
  ctx.globalAlpha = 1;
}
