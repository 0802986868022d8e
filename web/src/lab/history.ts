// The course of the trial, in columns, for the plots and the trails.

import type { StateMessage } from '../net/protocol.gen';
import { CARRIERS } from '../ui/controllers';

/** Columns of a sample in this order, in metres and seconds. */
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
  /** Its index in `CARRIERS`. */
  'controller',
] as const;
export type Column = (typeof COLUMNS)[number];
export type Sample = Readonly<Record<Column, number>>;
/** Samples in columns of equal length. */
export type Samples = Readonly<Record<Column, Float64Array>>;

export function columnsOf(column: (name: Column) => Float64Array): Samples {
  return Object.fromEntries(COLUMNS.map((name) => [name, column(name)])) as Record<
    Column,
    Float64Array
  >;
}

/** Enough for every tick of nine minutes, or every frame of eighteen minutes at 1×. Then old samples are thinned out. */
export const CAPACITY = 65_536;
/** Share of the newest samples of a full history that are not thinned out. */
const RECENT = 0.25;
/** A full history is thinned out down to this share. */
const THINNED = 0.875;

/** A trial from its start, in columns. The longer the trial, the coarser the old samples. */
export class History {
  private readonly columns: Samples;
  private end = 0;
  /** Ticks at which the bead was put elsewhere: it has no way from the sample before to the one after. */
  private readonly jumps = new Set<number>();
  /** Smallest number of ticks between two old samples. */
  private grainTicks = 1;

  constructor(private readonly capacity = CAPACITY) {
    this.columns = columnsOf(() => new Float64Array(capacity));
  }

  get length(): number {
    return this.end;
  }

  /** Time of the newest sample. */
  get newest_s(): number {
    return this.end === 0 ? 0 : this.at('sim_time_s', this.end - 1);
  }

  /** Adds the newest state. */
  push(state: StateMessage): void {
    this.add({
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
      controller: CARRIERS.indexOf(state.controller),
    });
  }

  /**
   * Adds a sample. One of the newest tick replaces the stored one, because the hand can move the bead while paused. An
   * older one follows a rewind and is not stored.
   */
  add(sample: Sample): void {
    const newest = this.length > 0 ? this.at('tick', this.length - 1) : -1;
    if (sample.tick < newest) return;
    if (sample.tick === newest) this.end -= 1;
    if (this.end === this.capacity) this.thin();
    for (const name of COLUMNS) this.columns[name][this.end] = sample[name];
    this.end += 1;
  }

  addJump(tick: number): void {
    this.jumps.add(tick);
  }

  /** Whether the bead was put elsewhere between two ticks. */
  hasJump(from: number, to: number): boolean {
    return [...this.jumps].some((tick) => from <= tick && tick <= to);
  }

  /** Removes the samples after `tick`: the session was rewound and continues from there. */
  cutAfter(tick: number): void {
    this.end = this.firstIndex('tick', tick, true);
  }

  clear(): void {
    this.end = 0;
    this.grainTicks = 1;
    this.jumps.clear();
  }

  /** Views of the samples with `fromS` ≤ time ≤ `toS`, oldest first; valid until the next push. */
  window(fromS: number, toS: number): Samples {
    const first = this.firstIndex('sim_time_s', fromS, false);
    const last = this.firstIndex('sim_time_s', toS, true);
    return columnsOf((name) => this.columns[name].subarray(first, Math.max(first, last)));
  }

  /** `name` of the last sample before `tick`, otherwise of the first sample. */
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

  /** Thins out old samples with the present grain, and with a larger grain only if that frees too little space. */
  private thin(): void {
    for (;;) {
      this.keepApart();
      if (this.end <= THINNED * this.capacity) return;
      this.grainTicks *= 2;
    }
  }

  /** Drops old samples that are nearer than the grain to the previous sample. */
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
