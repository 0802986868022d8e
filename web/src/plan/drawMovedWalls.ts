// Draws the walls where they are now, with the look of walls at rest. They move with every state: nothing is blurred.

import type { MovedWalls } from '../lab/movedWalls';
import type { BasePicture } from './layer';
import type { Ctx } from './sheet';
import { trayPath, unitM } from './tray';
import { pxRect, type View } from './transform';

const RIM = 1.5;
/** Shadows on the floor, from wide to near: offset and opacity. */
const SHADOWS = [
  [4.2, 7.4, 0.09],
  [3, 5.2, 0.11],
  [1.6, 2.6, 0.14],
] as const;

/** A path around what is not free. The outlines are moved into the walls by `into_px`. */
function wallPath(tray: Path2D, walls: MovedWalls, view: View, into_px: number): Path2D {
  const { point_m, normal } = walls;
  const { pxPerM, originX, originY } = view;
  // The tray runs clockwise and the outlines run the other way: what both enclose is free.
  const path = new Path2D(tray);
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
  { scene, view, palette }: BasePicture,
  walls: MovedWalls,
  tissue: CanvasPattern | string,
): void {
  const unit = unitM(scene.workspace) * view.pxPerM;
  const tray = trayPath(scene.workspace, view);
  const half = (RIM / 2) * unit;
  // A line is slower to draw than two surfaces. The upper one hides loops of an outline that has closed in on itself.
  const outer = wallPath(tray, walls, view, -half);
  ctx.save();
  ctx.beginPath();
  ctx.rect(...pxRect(view, scene.workspace));
  ctx.clip();
  ctx.fillStyle = palette['wall-shade'];
  for (const [x, y, opacity] of SHADOWS) {
    ctx.globalAlpha = opacity;
    ctx.translate(x * unit, y * unit);
    ctx.fill(outer);
    ctx.translate(-x * unit, -y * unit);
  }
  ctx.restore();
  ctx.fillStyle = palette['wall-rim'];
  ctx.fill(outer);
  ctx.fillStyle = tissue;
  ctx.fill(wallPath(tray, walls, view, half));
}
