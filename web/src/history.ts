// The last minute of states, in columns, for the plots and the trails.

import type { StateMessage } from './protocol.gen';

/** Columns of a sample, in this order; metres and seconds. */
export const COLUMNS = [
  'tick',
  'sim_time_s',
  'tool_x_m',
  'tool_y_m',
  'bead_x_m',
  'bead_y_m',
  'error_x_m',
  'error_y_m',
  'error_m',
] as const;
export type Column = (typeof COLUMNS)[number];

/** 60 s at 125 ticks a second fit, whatever the speed. */
export const CAPACITY = 8192;

/**
 * Keeps the newest `capacity` samples. Each column is twice as long as that, so that a window is a
 * view into it instead of a copy; the newer half moves to the front when the column is full.
 */
export class History {
  private readonly columns: Record<Column, Float64Array>;
  private start = 0;
  private end = 0;

  constructor(private readonly capacity = CAPACITY) {
    this.columns = Object.fromEntries(
      COLUMNS.map((name) => [name, new Float64Array(2 * capacity)]),
    ) as Record<Column, Float64Array>;
  }

  get length(): number {
    return this.end - this.start;
  }

  /**
   * Takes the newest state. One of the same tick replaces it: while time stands, a hand can still
   * move the bead. An older one is a look back and is not stored.
   */
  push(state: StateMessage): void {
    const newest = this.length > 0 ? this.at('tick', this.length - 1) : -1;
    if (state.tick < newest) return;
    if (state.tick === newest) this.end -= 1;
    if (this.end === 2 * this.capacity) this.moveToFront();
    const sample: Record<Column, number> = {
      tick: state.tick,
      sim_time_s: state.sim_time_s,
      tool_x_m: state.tool_m[0],
      tool_y_m: state.tool_m[1],
      bead_x_m: state.bead_m[0],
      bead_y_m: state.bead_m[1],
      error_x_m: state.tracking_error_x_m,
      error_y_m: state.tracking_error_y_m,
      error_m: state.tracking_error_m,
    };
    for (const name of COLUMNS) this.columns[name][this.end] = sample[name];
    this.end += 1;
    this.start = Math.max(this.start, this.end - this.capacity);
  }

  /** Forgets what lies after `tick`: time was turned back and runs on from there. */
  cutAfter(tick: number): void {
    this.end = this.start + this.firstIndex('tick', tick, true);
  }

  clear(): void {
    this.start = 0;
    this.end = 0;
  }

  /** Views of the samples with `fromS` ≤ time ≤ `toS`, oldest first; valid until the next push. */
  window(fromS: number, toS: number, names: readonly Column[]): Float64Array[] {
    const first = this.start + this.firstIndex('sim_time_s', fromS, false);
    const last = this.start + this.firstIndex('sim_time_s', toS, true);
    return names.map((name) => this.columns[name].subarray(first, Math.max(first, last)));
  }

  private at(name: Column, index: number): number {
    return this.columns[name][this.start + index] ?? Number.NaN;
  }

  /** Index of the first sample whose `name` is ≥ `bound`, or > `bound` when `above`. */
  private firstIndex(name: Column, bound: number, above: boolean): number {
    let low = 0;
    let high = this.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      const value = this.at(name, middle);
      if (value < bound || (above && value === bound)) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  private moveToFront(): void {
    for (const name of COLUMNS) this.columns[name].copyWithin(0, this.start, this.end);
    this.end -= this.start;
    this.start = 0;
  }
}
