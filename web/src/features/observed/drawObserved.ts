// Draws blocks and rectangles of the camera image, and the observed area.

import type { PixelBlock } from '../../lab/homography';
import type { Palette } from '../../ui/palette';
import type { BlocksLayer, SeenMessage } from '../../net/protocol.gen';
import { pxFromWorld, type View } from '../../plan/transform';
import { seenPixels } from './observed';
import { rgb } from '../../plan/colourRamp';

type Ctx = CanvasRenderingContext2D;

const UNKNOWN_ALPHA = 130;
const OBSTACLE_ALPHA = 120;

export interface Seen {
  readonly message: SeenMessage;
  /** A pixel a cell. */
  readonly image: HTMLCanvasElement;
}

export function createSeen(message: SeenMessage, palette: Palette): Seen {
  const image = document.createElement('canvas');
  image.width = message.columns;
  image.height = message.rows;
  const pixels = seenPixels(message, [
    [...rgb(palette.unseen), UNKNOWN_ALPHA],
    [0, 0, 0, 0],
    [...rgb(palette.sensed), OBSTACLE_ALPHA],
  ]);
  image.getContext('2d')?.putImageData(new ImageData(pixels, message.columns, message.rows), 0, 0);
  return { message, image };
}

export function drawSeen(ctx: Ctx, view: View, seen: Seen): void {
  const { workspace } = seen.message;
  const [left, top] = pxFromWorld(view, [workspace.x_min_m, workspace.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [workspace.x_max_m, workspace.y_min_m]);
  // No smoothing: cells have sharp edges.
  ctx.imageSmoothingEnabled = false;
  ctx.drawImage(seen.image, left, top, right - left, bottom - top);
  ctx.imageSmoothingEnabled = true;
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
export function drawBlocks(ctx: Ctx, view: View, palette: Palette, layer: BlocksLayer): void {
  const dark = blockPath(view, layer, layer.dark);
  ctx.lineWidth = 0.75;
  ctx.globalAlpha = 0.5;
  ctx.strokeStyle = palette.muted;
  ctx.stroke(blockPath(view, layer, layer.free));
  ctx.strokeStyle = palette.sensed;
  ctx.stroke(dark);
  ctx.globalAlpha = 0.15;
  ctx.fillStyle = palette.sensed;
  ctx.fill(dark);
  ctx.globalAlpha = 1;
}

export function drawRectangles(ctx: Ctx, view: View, palette: Palette, layer: BlocksLayer): void {
  const path = blockPath(view, layer, layer.rectangles);
  ctx.fillStyle = palette['error-x'];
  ctx.strokeStyle = palette['error-x'];
  ctx.globalAlpha = 0.12;
  ctx.fill(path);
  ctx.globalAlpha = 1;
  ctx.lineWidth = 1.25;
  ctx.stroke(path);
}
