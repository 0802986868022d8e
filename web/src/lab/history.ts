// The states of the trial, in columns, for the plots and the trails.

import type { StateMessage } from '../net/protocol.gen';

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
  'mode',
] as const;
export type Column = (typeof COLUMNS)[number];

/** Every tick of nine minutes, or every frame of eighteen at 1×; after that the past is thinned out. */
export const CAPACITY = 65_536;
/** Of a full history, this share of the newest samples is kept whole. */
const RECENT = 0.25;
/** A full history is thinned out until it is no fuller than this. */
const THINNED = 0.875;

/** The states of a trial in columns, from its start on: the longer it takes, the coarser the past. */
export class History {
  private readonly columns: Record<Column, Float64Array>;
  private end = 0;
  /** Least ticks between two samples of the past. */
  private grainTicks = 1;

  constructor(private readonly capacity = CAPACITY) {
    this.columns = Object.fromEntries(
      COLUMNS.map((name) => [name, new Float64Array(capacity)]),
    ) as Record<Column, Float64Array>;
  }

  get length(): number {
    return this.end;
  }

  /** Time of the newest sample. */
  get newest_s(): number {
    return this.end === 0 ? 0 : this.at('sim_time_s', this.end - 1);
  }

  /**
   * Takes the newest state. One of the same tick replaces it: while paused, a hand can still
   * move the bead. An older one is a look back and is not stored.
   */
  push(state: StateMessage): void {
    const newest = this.length > 0 ? this.at('tick', this.length - 1) : -1;
    if (state.tick < newest) return;
    if (state.tick === newest) this.end -= 1;
    if (this.end === this.capacity) this.thin();
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
      mode: state.mode,
    };
    for (const name of COLUMNS) this.columns[name][this.end] = sample[name];
    this.end += 1;
  }

  /** Forgets what lies after `tick`: time was turned back and runs on from there. */
  cutAfter(tick: number): void {
    this.end = this.firstIndex('tick', tick, true);
  }

  clear(): void {
    this.end = 0;
    this.grainTicks = 1;
  }

  /** Views of the samples with `fromS` ≤ time ≤ `toS`, oldest first; valid until the next push. */
  window(fromS: number, toS: number, names: readonly Column[]): Float64Array[] {
    const first = this.firstIndex('sim_time_s', fromS, false);
    const last = this.firstIndex('sim_time_s', toS, true);
    return names.map((name) => this.columns[name].subarray(first, Math.max(first, last)));
  }

  /** `name` of the last sample before `tick`, else of the first one. */
  before(tick: number, name: Column): number {
    return this.at(name, Math.max(0, this.firstIndex('tick', tick, false) - 1));
  }

  private at(name: Column, index: number): number {
    return this.columns[name][index] ?? Number.NaN;
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

  /** Makes the past as coarse as it is already, and coarser only when that leaves too little room. */
  private thin(): void {
    for (;;) {
      this.keepApart();
      if (this.end <= THINNED * this.capacity) return;
      this.grainTicks *= 2;
    }
  }

  /** Drops samples of the past that are nearer to the one before than the grain. */
  private keepApart(): void {
    const ticks = this.columns.tick;
    const recent = Math.floor(this.end * (1 - RECENT));
    let kept = 1;
    for (let from = 1; from < this.end; from++) {
      const since = (ticks[from] ?? 0) - (ticks[kept - 1] ?? 0);
      if (from < recent && since < this.grainTicks) continue;
      for (const name of COLUMNS) this.columns[name][kept] = this.columns[name][from] ?? 0;
      kept += 1;
    }
    this.end = kept;
  }
}
