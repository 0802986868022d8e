// The policy's value of each place as colours, and arrows of the best steps. Pure.

import { ACTIONS } from '../lab/actions';
import type { Vec2 } from '../lab/geometry';
import type { ValueCell, ValueMap } from '../net/protocol.gen';
import type { Arrow } from './arrows';
import { colourOf, luminance, type Ramp, type Range, rangeOf } from './colourRamp';

/** Arrow length as a share of the distance between two arrows. */
const LENGTH = 0.6;
/** Here black and white have the same contrast. */
const MIDDLE_LUMINANCE = 0.18;
/** Smallest distance between arrows, so that they stay readable. */
const MIN_ARROW_PX = 12;

/** The cells of a value map, with their distance. */
export type ValueCells = Pick<ValueMap, 'spacing_m' | 'cells'>;

export function valueRange(map: ValueCells): Range | undefined {
  return rangeOf(map.cells.map(({ value }) => value));
}

/** The smallest x and the largest y of the cells' middles, and a cell's column and row counted from there. */
function latticeOf({ cells, spacing_m }: ValueCells) {
  const left_m = Math.min(...cells.map(({ center_m }) => center_m[0]));
  const top_m = Math.max(...cells.map(({ center_m }) => center_m[1]));
  return {
    left_m,
    top_m,
    column: ({ center_m }: ValueCell) => Math.round((center_m[0] - left_m) / spacing_m),
    row: ({ center_m }: ValueCell) => Math.round((top_m - center_m[1]) / spacing_m),
  };
}

/** RGBA, one pixel per cell, upper row first. Transparent outside the cells. */
export interface ValuePicture {
  /** Upper left corner. */
  readonly corner_m: Vec2;
  readonly columns: number;
  readonly rows: number;
  readonly pixels: Uint8ClampedArray<ArrayBuffer>;
  /** Whether black is seen better than white on the colour of a value. */
  readonly isLight: (value: number) => boolean;
}

/** `range` has the values of the first and the last colour. */
export function valuePicture(
  map: ValueCells,
  ramp: Ramp,
  range: Range | undefined = valueRange(map),
): ValuePicture | undefined {
  if (!range || map.cells.length === 0) return undefined;
  const { left_m, top_m, column, row } = latticeOf(map);
  const columns = 1 + Math.max(...map.cells.map(column));
  const rows = 1 + Math.max(...map.cells.map(row));
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  for (const cell of map.cells) {
    pixels.set(
      [...colourOf(ramp, range, cell.value), 255],
      4 * (row(cell) * columns + column(cell)),
    );
  }
  const half_m = map.spacing_m / 2;
  return {
    corner_m: [left_m - half_m, top_m + half_m],
    columns,
    rows,
    pixels,
    isLight: (value) => luminance(colourOf(ramp, range, value)) > MIDDLE_LUMINANCE,
  };
}

/**
 * Arrows of the best step in each cell, or in every n-th cell along x and y if cells are small. `isWanted` chooses
 * cells by their value.
 */
export function valueArrows(
  map: ValueCells,
  pxPerM: number,
  isWanted: (value: number) => boolean = () => true,
): Arrow[] {
  const every = Math.max(1, Math.ceil(MIN_ARROW_PX / (map.spacing_m * pxPerM)));
  const half_m = (LENGTH / 2) * every * map.spacing_m;
  const { column, row } = latticeOf(map);
  return map.cells.flatMap((cell) => {
    const along = ACTIONS[cell.action]?.along;
    if (!along || column(cell) % every > 0 || row(cell) % every > 0) return [];
    if (!isWanted(cell.value)) return [];
    const [x_m, y_m] = cell.center_m;
    const [dx, dy] = [along[0] * half_m, along[1] * half_m];
    return [{ from_m: [x_m - dx, y_m - dy], to_m: [x_m + dx, y_m + dy], isSeen: true }];
  });
}
