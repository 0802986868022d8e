// Draws blocks and rectangles of the camera image, and the observed area.

import type { PixelBlock } from '../../lab/homography';
import { seenCells } from '../../lab/obstacleMap';
import type { BlocksLayer, OverlayMessage, Rect, SeenMessage } from '../../net/protocol.gen';
import { rgb } from '../../plan/colourRamp';
import { strokeCased } from '../../plan/marks';
import type { BasePicture } from '../../plan/layer';
import { gridPixels, imageOf, type Rgba } from '../../plan/pixels';
import { pxFromWorld, pxRect, type View } from '../../plan/transform';
import type { Ctx } from '../../plan/sheet';
import type { Palette } from '../../ui/palette';

const UNKNOWN_ALPHA = 130;
const OBSTACLE_ALPHA = 120;

export interface Seen {
  readonly workspace: Rect;
  readonly image: HTMLCanvasElement;
}

/** One pixel per cell. */
export function seenPixels(
  seen: SeenMessage,
  colors: readonly [unknown: Rgba, free: Rgba, obstacle: Rgba],
): Uint8ClampedArray<ArrayBuffer> {
  const cells = seenCells(seen);
  return gridPixels(seen.columns, seen.rows, (cell) => colors[cells[cell] as 0 | 1 | 2]);
}

export function createSeen(message: SeenMessage, palette: Palette): Seen {
  const pixels = seenPixels(message, [
    [...rgb(palette.unseen), UNKNOWN_ALPHA],
    [0, 0, 0, 0],
    [...rgb(palette.sensed), OBSTACLE_ALPHA],
  ]);
  return { workspace: message.workspace, image: imageOf(pixels, message.columns) };
}

export function drawSeen(ctx: Ctx, { view }: BasePicture, { workspace, image }: Seen): void {
  // No smoothing: cells have sharp edges.
  ctx.imageSmoothingEnabled = false;
  ctx.drawImage(image, ...pxRect(view, workspace));
}

function blockPath(view: View, layer: BlocksLayer, blocks: readonly PixelBlock[]): Path2D {
  const path = new Path2D();
  const [left, top] = pxFromWorld(view, layer.origin_m);
  const scale = layer.pixel_m * view.pxPerM;
  for (const [column, row, width, height] of blocks) {
    path.rect(left + column * scale, top + row * scale, width * scale, height * scale);
  }
  return path;
}

/** The quadtree: dark blocks filled, all blocks outlined. */
export function drawBlocks(
  ctx: Ctx,
  { view, palette }: BasePicture,
  { blocks: layer }: OverlayMessage,
): void {
  const dark = blockPath(view, layer, layer.dark);
  ctx.lineWidth = 0.75;
  ctx.globalAlpha = 0.5;
  ctx.strokeStyle = palette.sensed;
  ctx.stroke(blockPath(view, layer, layer.free));
  ctx.strokeStyle = palette.sensed;
  ctx.stroke(dark);
  ctx.globalAlpha = 0.15;
  ctx.fillStyle = palette.sensed;
  ctx.fill(dark);
  ctx.globalAlpha = 1;
}

export function drawRectangles(
  ctx: Ctx,
  { view, palette }: BasePicture,
  { blocks: layer }: OverlayMessage,
): void {
  const path = blockPath(view, layer, layer.rectangles);
  ctx.fillStyle = palette.sensed;
  ctx.globalAlpha = 0.12;
  ctx.fill(path);
  ctx.globalAlpha = 1;
  strokeCased(ctx, palette, { colour: palette.sensed, width_px: 1.4 }, path);
}
