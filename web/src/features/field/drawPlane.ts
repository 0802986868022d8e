// Draws the magnetic field layer. It moves with the tool.

import type { Palette } from '../../ui/palette';
import type { Plane } from '../../net/protocol.gen';
import { pxFromWorld, type View } from '../../plan/transform';
import { HALF_SIDE_M, planeArrows, planePixels, SIDE_PX } from './plane';
import type { Vec2 } from '../../lab/geometry';
import { type Arrow, arrowPath } from '../../plan/arrows';
import type { Ramp } from '../../plan/colourRamp';
import { imageOf } from '../../plan/pixels';

const ARROW_ALPHA = 0.6;

export interface FieldPicture {
  readonly image: HTMLCanvasElement;
  readonly arrows: readonly Arrow[];
}

export function createFieldPicture(plane: Plane, palette: Palette): FieldPicture {
  const ramp: Ramp = [palette['field-low'], palette['field-middle'], palette['field-high']];
  return { image: imageOf(planePixels(plane, ramp), SIDE_PX), arrows: planeArrows(plane) };
}

export function drawField(
  ctx: CanvasRenderingContext2D,
  view: View,
  palette: Palette,
  [x_m, y_m]: Vec2,
  field: FieldPicture,
): void {
  const side = 2 * HALF_SIDE_M * view.pxPerM;
  ctx.imageSmoothingEnabled = true;
  ctx.drawImage(
    field.image,
    ...pxFromWorld(view, [x_m - HALF_SIDE_M, y_m + HALF_SIDE_M]),
    side,
    side,
  );
  const [originX, originY] = pxFromWorld(view, [x_m, y_m]);
  ctx.save();
  ctx.strokeStyle = palette.text;
  ctx.lineWidth = 1;
  ctx.globalAlpha = ARROW_ALPHA;
  ctx.stroke(arrowPath({ ...view, originX, originY }, field.arrows));
  ctx.restore();
}
