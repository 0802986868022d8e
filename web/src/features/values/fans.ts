// Quantiles of the return as fans on a common axis. Pure.

/** Largest number of steps on the axis: more numbers would overlap. */
const MAX_STEPS = 5;
/** If the fans fill less than this share of the axis, the axis becomes shorter. */
const MIN_FILLED = 1 / 3;
/** Smallest length of the axis, for equal quantiles. */
const MIN_SPAN = 0.01;

export interface Fan {
  readonly min: number;
  /** A quarter of the returns is below. */
  readonly lower: number;
  readonly mean: number;
  /** A quarter of the returns is above. */
  readonly upper: number;
  readonly greatest: number;
}

/** From quantiles at the fractions (k + ½) / K. A network's quantiles may cross, so they are sorted first. */
export function fanOf(quantiles: readonly number[], mean: number): Fan {
  const sorted = [...quantiles].sort((a, b) => a - b);
  const last = sorted.length - 1;
  const at = (fraction: number): number => {
    const place = Math.min(last, Math.max(0, fraction * sorted.length - 0.5));
    const [below, above] = [sorted[Math.floor(place)] ?? mean, sorted[Math.ceil(place)] ?? mean];
    return below + (place % 1) * (above - below);
  };
  return { min: at(0), lower: at(0.25), mean, upper: at(0.75), greatest: at(1) };
}

export interface Axis {
  readonly from: number;
  readonly to: number;
  readonly step: number;
  readonly ticks: readonly number[];
}

/** An axis with round ends around all fans. The previous axis is kept while it fits, so that the axis rarely jumps. */
export function fanAxis(fans: readonly Fan[], before?: Axis): Axis {
  const min = Math.min(...fans.map((fan) => fan.min));
  const greatest = Math.max(...fans.map((fan) => fan.greatest));
  const isInside = before && before.from <= min && greatest <= before.to;
  if (isInside && greatest - min >= MIN_FILLED * (before.to - before.from)) return before;
  const finest = Math.max(MIN_SPAN, greatest - min) / MAX_STEPS;
  const power = 10 ** Math.floor(Math.log10(finest));
  const step = power * ([1, 2, 5].find((factor) => factor * power >= finest) ?? 10);
  const first = Math.floor(min / step);
  const last = Math.max(first + 1, Math.ceil(greatest / step));
  const ticks = Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
  return { from: first * step, to: last * step, step, ticks };
}

/** Position on the axis in percent. */
export function percentAlong({ from, to }: Axis, value: number): number {
  return (100 * (value - from)) / (to - from);
}

/** Index of the greatest value; the first one wins a tie. */
export const bestOf = (values: readonly number[]): number => values.indexOf(Math.max(...values));
