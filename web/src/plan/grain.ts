// The grain of tissue: soft noise on a tile that repeats. Pure.

export const GRAIN_PX = 256;
/** Cells of each octave along a side. The noise of an octave is half as strong as that of the one before. */
const OCTAVES = [13, 26, 52];
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
    const [u, v] = [(x * cells) / GRAIN_PX, (y * cells) / GRAIN_PX];
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

let tile: Float32Array | undefined;

/** 0 to 1 at each pixel of the tile, row after row. */
export function tissueGrain(): Float32Array {
  tile ??= Float32Array.from({ length: GRAIN_PX * GRAIN_PX }, (_, i) =>
    grainAt(i % GRAIN_PX, Math.floor(i / GRAIN_PX)),
  );
  return tile;
}
