// Draws the static parts of the workspace: floor, grid with numbers, walls.

import { fixed } from '../ui/format';
import type { Polygon, Rect } from '../net/protocol.gen';
import { pxFromWorld, pxRect, type View } from './transform';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

export const FONT = '11px system-ui, sans-serif';
const LABEL_GAP_PX = 5;
const TICK_PX = 4;
/** Line of a wall. */
export const EDGE_PX = 1;
const BORDER_PX = 2;
const MIN_LABEL_SPACING_PX = 56;

/** Spacing of the grid: the smallest of 5, 10, 20, 50 cm whose labels do not overlap. */
export function gridStepM(pxPerM: number): number {
  return [0.05, 0.1, 0.2].find((step) => step * pxPerM >= MIN_LABEL_SPACING_PX) ?? 0.5;
}

function* multiples(step: number, from: number, to: number): Generator<number> {
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9; i++) yield i * step;
}

function trace(path: Path2D, ring: readonly (readonly [number, number])[], view: View): void {
  ring.forEach((vertex, index) => {
    const [x, y] = pxFromWorld(view, vertex);
    if (index === 0) path.moveTo(x, y);
    else path.lineTo(x, y);
  });
  path.closePath();
}

export function wallPath(walls: readonly Polygon[], view: View): Path2D {
  const path = new Path2D();
  for (const wall of walls) {
    trace(path, wall.exterior, view);
    for (const hole of wall.holes) trace(path, hole, view);
  }
  return path;
}

/** The lines of the grid, and the numbers beside the workspace. */
export function drawGrid(ctx: Ctx, rect: Rect, view: View, palette: Palette): void {
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

export function drawFloor(ctx: Ctx, rect: Rect, view: View, palette: Palette): void {
  ctx.fillStyle = palette.floor;
  ctx.fillRect(...pxRect(view, rect));
}

/** The walls and the border. */
export function drawOutlines(
  ctx: Ctx,
  rect: Rect,
  walls: Path2D,
  view: View,
  palette: Palette,
): void {
  ctx.fillStyle = palette.wall;
  ctx.fill(walls, 'evenodd');
  ctx.strokeStyle = palette['wall-rim'];
  ctx.lineWidth = EDGE_PX;
  ctx.stroke(walls);
  drawBorder(ctx, rect, view, palette);
}

/** The borders are walls too. */
export function drawBorder(ctx: Ctx, rect: Rect, view: View, palette: Palette): void {
  ctx.strokeStyle = palette['wall-rim'];
  ctx.lineWidth = BORDER_PX;
  ctx.strokeRect(...pxRect(view, rect));
}
