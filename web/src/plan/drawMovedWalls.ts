// Draws the walls where they are now, with the look of walls at rest. They move with every state: nothing is blurred.

import type { MovedWalls } from '../lab/movedWalls';
import type { BasePicture } from './layer';
import type { Relief } from './relief';
import { contextOf, type Ctx } from './sheet';
import type { Palette } from '../ui/palette';
import { reliefPx, trayPath } from './tray';
import { pxRect, type View } from './transform';

const RIM = 1.5;
/** Of the shadow on the floor: opacity, and pixels of the map per pixel of its picture, which makes it soft. */
const SHADE = 0.3;
const COARSE = 4;
const SHADOW_TO = [2.8, 4.8] as const;

let shadow: HTMLCanvasElement | undefined;

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

function drawShadow(ctx: Ctx, solid: Path2D, unit: number, palette: Palette): void {
  const ratio = ctx.getTransform().a;
  const [width, height] = [ctx.canvas.width / ratio, ctx.canvas.height / ratio];
  shadow ??= document.createElement('canvas');
  const onto = contextOf(shadow, { width, height }, ratio / COARSE);
  if (!onto) return;
  onto.translate(SHADOW_TO[0] * unit, SHADOW_TO[1] * unit);
  onto.fillStyle = palette['wall-shade'];
  onto.fill(solid);
  ctx.globalAlpha = SHADE;
  const [wide, high] = [shadow.width, shadow.height].map((px) => (px * COARSE) / ratio);
  ctx.drawImage(shadow, 0, 0, wide ?? width, high ?? height);
  ctx.globalAlpha = 1;
}

export function drawMovedWalls(
  ctx: Ctx,
  { scene, view, palette }: BasePicture,
  walls: MovedWalls,
  relief: Relief,
  isStill: boolean,
): void {
  const unit = reliefPx(scene.workspace, view);
  const tray = trayPath(scene.workspace, view);
  const half = (RIM / 2) * unit;
  const outer = wallPath(tray, walls, view, -half);
  ctx.save();
  ctx.beginPath();
  ctx.rect(...pxRect(view, scene.workspace));
  ctx.clip();
  drawShadow(ctx, outer, unit, palette);
  // A line is slower to draw than two surfaces. The upper one hides loops of an outline that has closed in on itself.
  ctx.fillStyle = palette['wall-rim'];
  ctx.fill(outer);
  ctx.restore();
  relief.drawMoved(ctx, view, isStill, wallPath(tray, walls, view, half));
}
