// Draws the walls where they are now, with the look of walls at rest.

import type { MovedWalls } from '../lab/movedWalls';
import type { Rect } from '../net/protocol.gen';
import type { Palette } from '../ui/palette';
import { drawBorder, EDGE_PX } from './drawMap';
import { pxFromWorld, type View } from './transform';

/** A path around what is not free. The outlines are moved into the walls by half of their line. */
function wallPath(table: Path2D, walls: MovedWalls, view: View): Path2D {
  const { point_m, normal } = walls;
  const { pxPerM, originX, originY } = view;
  const into_px = EDGE_PX / 2;
  // The table runs clockwise and the outlines run the other way: what both enclose is free.
  const path = new Path2D(table);
  for (const [from, to] of walls.outlines) {
    for (let i = from; i < to; i++) {
      const x = originX + (point_m[2 * i] ?? 0) * pxPerM - (normal[2 * i] ?? 0) * into_px;
      const y = originY - (point_m[2 * i + 1] ?? 0) * pxPerM + (normal[2 * i + 1] ?? 0) * into_px;
      if (i === from) path.moveTo(x, y);
      else path.lineTo(x, y);
    }
    path.closePath();
  }
  return path;
}

export function drawMovedWalls(
  ctx: CanvasRenderingContext2D,
  rect: Rect,
  walls: MovedWalls,
  view: View,
  palette: Palette,
): void {
  const [left, top] = pxFromWorld(view, [rect.x_min_m, rect.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [rect.x_max_m, rect.y_min_m]);
  const table = new Path2D();
  table.rect(left, top, right - left, bottom - top);
  const path = wallPath(table, walls, view);
  ctx.save();
  ctx.clip(table);
  ctx.lineJoin = 'bevel';
  ctx.lineWidth = 2 * EDGE_PX;
  ctx.strokeStyle = palette['wall-edge'];
  ctx.stroke(path);
  // Hides the inner half of the line, and loops of an outline that has closed in on itself.
  ctx.fillStyle = palette.wall;
  ctx.fill(path);
  ctx.restore();
  drawBorder(ctx, rect, view, palette);
}
