// Rows over varied parameters: curves over one, a grid over two. Pure.

import { controllerLabel } from '../../lab/parameters';
import type { ControllerName, EvaluationCell, Row } from '../../net/protocol.gen';
import type { Interval, Measure, Points } from '../../ui/series';
import { shown } from './varied';

export interface Point {
  readonly row: Row;
  /** In the order of the parameters, in shown units. */
  readonly at: readonly number[];
}

export interface Line {
  readonly label: string;
  readonly controller: ControllerName;
  readonly points: readonly Point[];
}

/** The rows of one map and number of disturbances. */
export interface Picture {
  readonly map: string;
  readonly disturbances: number;
  readonly lines: readonly Line[];
}

/** The items of each key, in the order of their first ones. */
function grouped<T>(items: readonly T[], key: (item: T) => string): (readonly [T, ...T[]])[] {
  const groups = new Map<string, [T, ...T[]]>();
  for (const item of items) {
    const group = groups.get(key(item));
    if (group) group.push(item);
    else groups.set(key(item), [item]);
  }
  return [...groups.values()];
}

/** One picture for each map and number of disturbances. Its lines are those of all cells, its points those so far. */
export function picturesOf(
  cells: readonly EvaluationCell[],
  rows: readonly Row[],
): readonly Picture[] {
  const all = cells
    .map((cell, index) => ({ cell, row: rows[index] }))
    .filter(({ cell }) => cell.varied.length > 0);
  return grouped(all, ({ cell }) => `${cell.map} ${cell.disturbances}`).map((ofPicture) => ({
    map: ofPicture[0].cell.map,
    disturbances: ofPicture[0].cell.disturbances,
    lines: grouped(ofPicture, ({ cell }) => controllerLabel(cell)).map((ofLine) => ({
      label: controllerLabel(ofLine[0].cell),
      controller: ofLine[0].cell.controller,
      points: ofLine.flatMap(({ cell, row }) =>
        row ? [{ row, at: cell.varied.map(({ name, value }) => shown(name, value)) }] : [],
      ),
    })),
  }));
}

export interface RowMeasure extends Measure {
  readonly values: (row: Row) => Interval;
}

export const MEASURES: readonly RowMeasure[] = [
  {
    title: 'Delivered',
    unit: '%, bars: Wilson, 95 %',
    values: ({ wilson95, delivered, episodes }) => [
      100 * wilson95[1],
      100 * wilson95[0],
      (100 * delivered) / episodes,
    ],
    digits: 0,
    axisDigits: 0,
    range: () => [0, 100],
    intervals: 'bars',
  },
  {
    title: 'Mean tracking error',
    unit: "mm, bars: Student's t, 95 %",
    values: ({ tracking_error_mean95_m: interval_m, tracking_error_mean_m }) =>
      interval_m
        ? [1e3 * interval_m[1], 1e3 * interval_m[0], 1e3 * tracking_error_mean_m]
        : [null, null, null],
    digits: 1,
    axisDigits: 0,
    range: (max) => [0, 1.1 * max || 1],
    intervals: 'bars',
  },
];

/** Values of one parameter that occur, in order. */
export function valuesOf(picture: Picture, parameter: number): number[] {
  const values = picture.lines.flatMap(({ points }) => points.map(({ at }) => at[parameter] ?? 0));
  return [...new Set(values)].sort((a, b) => a - b);
}

/** The points of each line over the first parameter. */
export const pointsOf = ({ values }: RowMeasure, { lines }: Picture): Points[] =>
  lines.map(({ points }) => points.map(({ at, row }) => [at[0] ?? 0, values(row)]));

/** Delivered shares of a line over two parameters: one row for each value of the first one, the largest on top. */
export function gridOf(picture: Picture, line: Line): readonly (readonly (Row | undefined)[])[] {
  const find = (up: number, right: number): Row | undefined =>
    line.points.find(({ at }) => at[0] === up && at[1] === right)?.row;
  const rights = valuesOf(picture, 1);
  return valuesOf(picture, 0)
    .reverse()
    .map((up) => rights.map((right) => find(up, right)));
}
