// Draws the walls where they are now, with the look of walls at rest.

import type { MovedWalls } from '../lab/movedWalls';
import type { Rect } from '../net/protocol.gen';
import { drawBorder, EDGE_PX } from './drawMap';
import { pxRect, type View } from './transform';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

/** A path around what is not free. The outlines are moved into the walls by `into_px`. */
function wallPath(table: Path2D, walls: MovedWalls, view: View, into_px: number): Path2D {
  const { point_m, normal } = walls;
  const { pxPerM, originX, originY } = view;
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
  ctx: Ctx,
  rect: Rect,
  walls: MovedWalls,
  view: View,
  palette: Palette,
): void {
  const table = new Path2D();
  table.rect(...pxRect(view, rect));
  ctx.save();
  ctx.clip(table);
  // Lines of one pixel are drawn much faster than wider ones.
  ctx.strokeStyle = palette['wall-rim'];
  ctx.lineWidth = EDGE_PX;
  ctx.stroke(wallPath(table, walls, view, 0));
  // Hides loops of an outline that has closed in on itself.
  ctx.fillStyle = palette.wall;
  ctx.fill(wallPath(table, walls, view, EDGE_PX / 2));
  ctx.restore();
  drawBorder(ctx, rect, view, palette);
}
