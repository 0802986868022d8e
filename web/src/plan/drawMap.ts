// Draws the floor with its marks.

import type { Rect } from '../net/protocol.gen';
import { pxFromWorld, pxRect, type View } from './transform';
import { unitM } from './tray';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

const MIN_LABEL_SPACING_PX = 56;
const MIN_MARK_SPACING_PX = 36;
/** Half a mark of the floor, in units of the tray. */
const MARK = 2.5;

/** The smallest of 5, 10, 20, 50 cm that is so many pixels long. */
export function gridStepM(pxPerM: number, least_px = MIN_LABEL_SPACING_PX): number {
  return [0.05, 0.1, 0.2].find((step) => step * pxPerM >= least_px) ?? 0.5;
}

export function* multiples(step: number, from: number, to: number): Generator<number> {
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9; i++) yield i * step;
}

/** The floor, with a small mark every 5 cm. */
export function drawFloor(ctx: Ctx, rect: Rect, view: View, palette: Palette): void {
  ctx.fillStyle = palette.floor;
  ctx.fillRect(...pxRect(view, rect));
  const step = gridStepM(view.pxPerM, MIN_MARK_SPACING_PX);
  const half = MARK * unitM(rect) * view.pxPerM;
  ctx.beginPath();
  for (const x_m of multiples(step, rect.x_min_m + step / 2, rect.x_max_m - step / 2)) {
    for (const y_m of multiples(step, rect.y_min_m + step / 2, rect.y_max_m - step / 2)) {
      const [x, y] = pxFromWorld(view, [x_m, y_m]);
      ctx.moveTo(x - half, y);
      ctx.lineTo(x + half, y);
      ctx.moveTo(x, y - half);
      ctx.lineTo(x, y + half);
    }
  }
  ctx.strokeStyle = palette['floor-grid'];
  ctx.lineWidth = 1.2;
  ctx.stroke();
}
