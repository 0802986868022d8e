// The cells of a training's map: which one is at a place, and what a value map says of
// each. Pure.

import { distance, leastOf, type Vec2 } from '../../lab/geometry';
import type { EpisodeEnding, Rect, TrainingCells, TrainingFrame } from '../../net/protocol.gen';
import type { ValueCells } from '../../plan/values';

/** A place farther than this from each cell, in cells, belongs to none. */
const MOST_CELLS = 1.5;
/** Index of the cell at a place; undefined far from all cells. */
export function cellAt({ centers_m, spacing_m }: TrainingCells, place: Vec2): number | undefined {
  return leastOf(centers_m, (center) => {
    const distance_m = distance(center, place);
    return distance_m <= MOST_CELLS * spacing_m ? distance_m : Infinity;
  });
}

/** A frame's values in the form that the plan draws. */
export function valueCells(cells: TrainingCells, frame: TrainingFrame): ValueCells {
  return {
    spacing_m: cells.spacing_m,
    cells: cells.centers_m.map((center_m, index) => ({
      center_m,
      value: frame.values[index] ?? 0,
      action: frame.actions[index] ?? -1,
    })),
  };
}

/** The smallest rectangle around all cells, for a map whose drawing is missing. */
export function around({ centers_m, spacing_m }: TrainingCells): Rect {
  const half_m = spacing_m / 2;
  const [xs, ys] = [centers_m.map(([x]) => x), centers_m.map(([, y]) => y)];
  return {
    x_min_m: Math.min(...xs) - half_m,
    x_max_m: Math.max(...xs) + half_m,
    y_min_m: Math.min(...ys) - half_m,
    y_max_m: Math.max(...ys) + half_m,
  };
}

/** Indices of the starts from which an episode ends so. */
export function startsThat(frame: TrainingFrame, ending: EpisodeEnding): number[] {
  return frame.endings.flatMap((one, index) => (one === ending ? [index] : []));
}

/** Quantiles .05, .25, .5, .75 and .95 at a cell, over the updates. A network's quantiles may cross, so they are sorted. */
export interface Fan {
  readonly updates: readonly number[];
  /** One list per quantile. */
  readonly quantiles: readonly (readonly number[])[];
}

export function fanAt(frames: readonly TrainingFrame[], cell: number): Fan {
  const rows = frames.map(({ quantiles }) => [...(quantiles[cell] ?? [])].sort((a, b) => a - b));
  return {
    updates: frames.map(({ update }) => update),
    quantiles: [0, 1, 2, 3, 4].map((index) => rows.map((row) => row[index] ?? NaN)),
  };
}
