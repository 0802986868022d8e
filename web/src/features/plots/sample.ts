// The data of the figure: a window of the history, thinned to what a screen can show. Pure.

import { type Column, COLUMNS, columnsOf, type History, type Samples } from '../../lab/history';
import type { Span } from '../../lab/timeAxis';
import type { EventMessage } from '../../net/protocol.gen';
import { CARRIERS } from '../../ui/controllers';

/** Number of intervals with extremes: more than the pixels of one part. */
const INTERVALS = 300;
/** Columns with peaks. The tool is too slow for peaks. */
const PEAKS: readonly Column[] = ['bead_x_m', 'bead_y_m', 'error_m'];

export interface Struck {
  readonly time_s: number;
  /** Where the bead was. */
  readonly at_m: readonly [number, number];
}

export interface Sample extends Span {
  /** The present time. It is before the newest sample after a rewind. */
  readonly at_s: number;
  readonly columns: Samples;
  /** When sub-controller 1 was active. */
  readonly approaches: readonly (readonly [from_s: number, to_s: number])[];
  readonly struck: readonly Struck[];
}

/** Indices of the first sample and the extremes in `columns` of each interval, and of the last sample. */
export function thinnedIndices(
  length: number,
  columns: readonly Float64Array[],
  intervals: number,
): number[] {
  const perInterval = 2 * columns.length + 1;
  if (length <= intervals * perInterval) return Array.from({ length }, (_, index) => index);
  const indices: number[] = [];
  for (let interval = 0; interval < intervals; interval++) {
    const first = Math.floor((interval * length) / intervals);
    const end = Math.floor(((interval + 1) * length) / intervals);
    const picked = new Set([first]);
    for (const column of columns) {
      let min = first;
      let max = first;
      for (let index = first + 1; index < end; index++) {
        if ((column[index] ?? 0) < (column[min] ?? 0)) min = index;
        if ((column[index] ?? 0) > (column[max] ?? 0)) max = index;
      }
      picked.add(min).add(max);
    }
    indices.push(...[...picked].sort((a, b) => a - b));
  }
  if (indices.at(-1) !== length - 1) indices.push(length - 1);
  return indices;
}

/** Intervals in which `values` equals `wanted`, each up to the next sample. */
export function spansOf(
  times: Float64Array,
  values: Float64Array,
  wanted: number,
): [number, number][] {
  const spans: [number, number][] = [];
  let from: number | undefined;
  values.forEach((value, index) => {
    const time_s = times[index] ?? 0;
    if (value === wanted) {
      from ??= time_s;
    } else if (from !== undefined) {
      spans.push([from, time_s]);
      from = undefined;
    }
  });
  if (from !== undefined) spans.push([from, times.at(-1) ?? from]);
  return spans;
}

export function takeSample(
  history: History,
  { from_s, to_s }: Span,
  at_s: number,
  marks: readonly EventMessage[],
): Sample {
  const all = history.window(from_s, to_s);
  const times = all.sim_time_s;
  const indices = thinnedIndices(
    times.length,
    PEAKS.map((name) => all[name]),
    INTERVALS,
  );
  return {
    from_s,
    to_s,
    at_s,
    columns: columnsOf((name) => Float64Array.from(indices, (index) => all[name][index] ?? NaN)),
    approaches: spansOf(times, all.mode, 1),
    struck: marks
      .filter(
        ({ kind, sim_time_s }) =>
          kind === 'disturbance' && sim_time_s >= from_s && sim_time_s <= to_s,
      )
      .map(({ tick, sim_time_s }) => ({
        time_s: sim_time_s,
        at_m: [history.before(tick, 'bead_x_m'), history.before(tick, 'bead_y_m')],
      })),
  };
}

/** Index of the sample nearest to `time_s`; undefined without samples. */
export function nearestIndex(times: Float64Array, time_s: number): number | undefined {
  if (times.length === 0) return undefined;
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= time_s) low = middle;
    else high = middle;
  }
  return time_s - (times[low] ?? 0) <= (times[high] ?? 0) - time_s ? low : high;
}

/** The window as CSV with every sample, in metres and seconds. `disturbed` counts disturbances since the previous line. */
export function csvOf(history: History, { from_s, to_s, struck }: Sample): string {
  const all = history.window(from_s, to_s);
  const lines = [[...COLUMNS, 'disturbed'].join(',')];
  let next = 0;
  all.sim_time_s.forEach((time_s, index) => {
    let disturbed = 0;
    while ((struck[next]?.time_s ?? Infinity) <= time_s) {
      disturbed += 1;
      next += 1;
    }
    const cells = COLUMNS.map((name) => {
      const value = all[name][index] ?? 0;
      return name === 'controller' ? CARRIERS[value] : String(Number(value.toFixed(6)));
    });
    lines.push([...cells, disturbed].join(','));
  });
  return `${lines.join('\n')}\n`;
}
