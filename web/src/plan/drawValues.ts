// Draws the value layer: one colour per cell, and arrows of the best steps.

import { pxFromWorld, type View } from './transform';
import { type ValueCells, valueArrows, valuePicture, type ValuePicture } from './values';
import { arrowPath } from './arrows';
import { type Range, rampOf } from './colourRamp';
import { imageOf } from './pixels';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

export interface Values {
  readonly map: ValueCells;
  readonly picture: ValuePicture;
  readonly image: HTMLCanvasElement;
}

/** `range` has the values of the first and the last colour. */
export function createValues(map: ValueCells, palette: Palette, range?: Range): Values | undefined {
  const picture = valuePicture(map, rampOf(palette, 'value'), range);
  return picture && { map, picture, image: imageOf(picture.pixels, picture.columns) };
}

export function drawColours(ctx: Ctx, view: View, { map, picture, image }: Values): void {
  const side = map.spacing_m * view.pxPerM;
  // No smoothing: each cell has its own value.
  ctx.imageSmoothingEnabled = false;
  const at = pxFromWorld(view, picture.corner_m);
  ctx.drawImage(image, ...at, picture.columns * side, picture.rows * side);
}

/** White on dark colours, black on light ones. */
export function drawArrows(ctx: Ctx, view: View, { map, picture }: Values): void {
  ctx.save();
  ctx.lineWidth = 1.3;
  for (const isOnLight of [true, false]) {
    ctx.strokeStyle = isOnLight ? 'rgb(27 17 8 / 0.72)' : 'rgb(255 255 255 / 0.8)';
    const isWanted = (value: number): boolean => picture.isLight(value) === isOnLight;
    ctx.stroke(arrowPath(view, valueArrows(map, view.pxPerM, isWanted)));
  }
  ctx.restore();
}
