// Draws the static parts of the workspace below the walls: the floor with its marks, and the numbers beside it.

import { fixed } from '../ui/format';
import type { Rect } from '../net/protocol.gen';
import { pxFromWorld, pxRect, type View } from './transform';
import { unitM } from './tray';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

export const FONT = "500 12px 'Inter Variable', system-ui, sans-serif";
const LABEL_GAP_PX = 5;
const TICK_PX = 4;
const BORDER_PX = 2;
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

/** The numbers beside the workspace. */
export function drawNumbers(ctx: Ctx, rect: Rect, view: View, palette: Palette): void {
  const [left, top] = pxFromWorld(view, [rect.x_min_m, rect.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [rect.x_max_m, rect.y_min_m]);
  const step = gridStepM(view.pxPerM);
  ctx.font = FONT;
  ctx.fillStyle = palette['ink-3'];
  ctx.strokeStyle = palette['floor-grid'];
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.textAlign = 'center';
  ctx.textBaseline = 'top';
  for (const x_m of multiples(step, rect.x_min_m, rect.x_max_m)) {
    const x = Math.round(pxFromWorld(view, [x_m, 0])[0]) + 0.5;
    ctx.moveTo(x, top);
    ctx.lineTo(x, bottom + TICK_PX);
    ctx.fillText(fixed(x_m, step < 0.1 ? 2 : 1), x, bottom + TICK_PX + LABEL_GAP_PX - 2);
  }
  ctx.textAlign = 'right';
  ctx.textBaseline = 'middle';
  for (const y_m of multiples(step, rect.y_min_m, rect.y_max_m)) {
    const y = Math.round(pxFromWorld(view, [0, y_m])[1]) + 0.5;
    ctx.moveTo(left - TICK_PX, y);
    ctx.lineTo(right, y);
    ctx.fillText(fixed(y_m, step < 0.1 ? 2 : 1), left - TICK_PX - LABEL_GAP_PX, y);
  }
  ctx.stroke();
}

/** The borders are walls too. */
export function drawBorder(ctx: Ctx, rect: Rect, view: View, palette: Palette): void {
  ctx.strokeStyle = palette['wall-rim'];
  ctx.lineWidth = BORDER_PX;
  ctx.strokeRect(...pxRect(view, rect));
}
