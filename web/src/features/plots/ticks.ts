// Round numbers on an axis. Pure.

import { duration } from '../../ui/format';

const TIMES = 8;
/** A lane lower than this has numbers at its ends only. */
const HIGH_PX = 70;
/** Of one number. */
const ROW_PX = 28;

/** About `count` round numbers from `low` to `high`. */
export function roundTicks(low: number, high: number, count: number): number[] {
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5, 10].find((factor) => factor * power >= raw * (1 - 1e-9)) ?? 10) * power;
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) {
    // No negative zero.
    ticks.push(k * step + 0);
  }
  return ticks;
}

export const timeTicks = ({ from_s, to_s }: { from_s: number; to_s: number }): number[] =>
  roundTicks(from_s, to_s, TIMES);

export const tickWords = (time_s: number): string =>
  time_s < 60 ? `${Number(time_s.toFixed(3))} s` : duration(time_s);

/** The round numbers of a lane that is high enough. */
export const laneTicks = ([low, high]: readonly [number, number], height_px: number): number[] =>
  height_px < HIGH_PX ? [] : roundTicks(low, high, Math.min(5, Math.floor(height_px / ROW_PX)));
