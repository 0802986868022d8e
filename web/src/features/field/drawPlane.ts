// Draws the magnetic field layer.

import type { Plane } from '../../net/protocol.gen';
import { pxFromWorld, type View } from '../../plan/transform';
import { HALF_SIDE_M, planeArrows, planePixels, SIDE_PX } from './plane';
import { type Arrow, arrowPath } from '../../plan/arrows';
import { rampOf } from '../../plan/colourRamp';
import { imageOf } from '../../plan/pixels';
import type { Ctx } from '../../plan/sheet';
import type { Palette } from '../../ui/palette';

const ARROW_ALPHA = 0.6;

export interface FieldPicture {
  readonly image: HTMLCanvasElement;
  readonly arrows: readonly Arrow[];
}

export function createFieldPicture(plane: Plane, palette: Palette): FieldPicture {
  const ramp = rampOf(palette, 'field');
  return { image: imageOf(planePixels(plane, ramp), SIDE_PX), arrows: planeArrows(plane) };
}

/** Around the origin of the view. */
export function drawField(ctx: Ctx, view: View, palette: Palette, field: FieldPicture): void {
  const side = 2 * HALF_SIDE_M * view.pxPerM;
  ctx.drawImage(field.image, ...pxFromWorld(view, [-HALF_SIDE_M, HALF_SIDE_M]), side, side);
  ctx.strokeStyle = palette['m-ink'];
  ctx.lineWidth = 1;
  ctx.globalAlpha = ARROW_ALPHA;
  ctx.stroke(arrowPath(view, field.arrows));
}
