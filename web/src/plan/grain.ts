// The grain of tissue: a tile of soft noise that repeats.

import { imageOf } from './pixels';
import type { Ctx } from './sheet';

const SIDE_PX = 256;
/** Cells of each octave along a side. The noise of a cell is half as strong in the next one. */
const OCTAVES = [13, 26, 52];
const COLOUR = [64, 20, 13] as const;
const MOST_ALPHA = 13;
const SEED = 7;

/** A number from 0 to 1 for each place of a lattice; the same at every start. */
function noiseAt(column: number, row: number, octave: number): number {
  const mixed = Math.imul(column * 374_761_393 + row * 668_265_263 + octave * 1_274_126_177, SEED);
  const spread = Math.imul(mixed ^ (mixed >>> 13), 1_274_126_177);
  return ((spread ^ (spread >>> 16)) >>> 0) / 2 ** 32;
}

const smooth = (t: number): number => t * t * (3 - 2 * t);
const mix = (a: number, b: number, share: number): number => a + share * (b - a);

function grainAt(x: number, y: number): number {
  let [sum, most] = [0, 0];
  OCTAVES.forEach((cells, octave) => {
    const [u, v] = [(x * cells) / SIDE_PX, (y * cells) / SIDE_PX];
    const [column, row] = [Math.floor(u), Math.floor(v)];
    const at = (dx: number, dy: number): number =>
      noiseAt((column + dx) % cells, (row + dy) % cells, octave);
    const along = smooth(u - column);
    const upper = mix(at(0, 0), at(1, 0), along);
    sum += mix(upper, mix(at(0, 1), at(1, 1), along), smooth(v - row)) / 2 ** octave;
    most += 1 / 2 ** octave;
  });
  return sum / most;
}

let tile: HTMLCanvasElement | undefined;

/** One pixel of the tile is one unit of the pattern. */
export function tissueGrain(ctx: Ctx): CanvasPattern | null {
  if (!tile) {
    const pixels = new Uint8ClampedArray(4 * SIDE_PX * SIDE_PX);
    for (let i = 0; i < SIDE_PX * SIDE_PX; i++) {
      const grain = grainAt(i % SIDE_PX, Math.floor(i / SIDE_PX));
      pixels.set([...COLOUR, MOST_ALPHA * Math.max(0, 1.8 * grain - 0.6)], 4 * i);
    }
    tile = imageOf(pixels, SIDE_PX);
  }
  return ctx.createPattern(tile, 'repeat');
}
