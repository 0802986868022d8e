// The observed area as a picture. Pure.

import type { SeenMessage } from '../../net/protocol.gen';
import { seenCells } from '../../lab/obstacleMap';

export type Rgba = readonly [number, number, number, number];

/** RGBA, one pixel per cell, upper row first. */
export function seenPixels(
  seen: SeenMessage,
  colors: readonly [unknown: Rgba, free: Rgba, obstacle: Rgba],
): Uint8ClampedArray<ArrayBuffer> {
  const { columns, rows } = seen;
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  seenCells(seen).forEach((state, cell) => {
    const row = rows - 1 - Math.floor(cell / columns);
    pixels.set(colors[state as 0 | 1 | 2], 4 * (row * columns + (cell % columns)));
  });
  return pixels;
}
