// What the camera has shown of the workspace, as a picture. Pure.

import type { SeenMessage } from '../protocol.gen';

export const UNKNOWN = 0;
export const FREE = 1;
export const OBSTACLE = 2;

export type Rgba = readonly [number, number, number, number];

/** A pixel a cell, RGBA, the upper row first as in a picture. */
export function seenPixels(
  seen: SeenMessage,
  colors: readonly [unknown: Rgba, free: Rgba, obstacle: Rgba],
): Uint8ClampedArray<ArrayBuffer> {
  const { columns, rows } = seen;
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  let cell = 0;
  for (const [state, count] of seen.runs) {
    const color = colors[state as 0 | 1 | 2];
    for (const end = Math.min(cell + count, columns * rows); cell < end; cell++) {
      const row = rows - 1 - Math.floor(cell / columns);
      pixels.set(color, 4 * (row * columns + (cell % columns)));
    }
  }
  return pixels;
}

/** Share of the workspace that was seen. */
export function seenShare(seen: SeenMessage): number {
  const known = seen.runs.reduce((sum, [state, count]) => sum + (state === UNKNOWN ? 0 : count), 0);
  return known / (seen.columns * seen.rows);
}
