// Speeds and steps of simulated time. Pure.

import { fixed, speed } from '../../ui/format';
import { CONTROL_PERIOD_S, SPEED_MAX } from '../../net/protocol.gen';

export const SPEEDS: readonly number[] = [0.125, 0.25, 0.5, 1, 2, 4, 8, SPEED_MAX];
/** Below this share of the requested speed, the machine is at its limit. */
const LIMITED = 0.85;

/** The next speed up (1) or down (−1); the same at the end of the range. */
export function nextSpeed(target: number, direction: 1 | -1): number {
  const further = SPEEDS.filter((factor) => (factor - target) * direction > 0);
  return (direction > 0 ? further[0] : further.at(-1)) ?? target;
}

/** Number of ticks to the next control step. */
export function ticksToControlStep(tick: number, tick_s: number): number {
  const stepsBefore = Math.floor((tick * tick_s) / CONTROL_PERIOD_S + 1e-9);
  const due = Math.ceil(((stepsBefore + 1) * CONTROL_PERIOD_S) / tick_s - 1e-9);
  return due - tick;
}

/** The achieved speed if it is clearly below the requested one. An achieved speed of 0 means not measured yet. */
export function limitWords(target: number, achieved: number): string | undefined {
  if (achieved === 0 || achieved >= LIMITED * target) return undefined;
  return `only ${fixed(achieved, achieved < 10 ? 2 : 1)}×`;
}

/** Ticks come every 8 ms. Undefined if the delay is shorter than about two ticks. */
const LATE_MS = 20;

export function lateWords(lateness_ms: number): string | undefined {
  return lateness_ms > LATE_MS ? `${Math.round(lateness_ms)} ms late` : undefined;
}

/** How often the session fell so far behind that it gave up the lost time. */
export function lostWords(times: number): string | undefined {
  if (times === 0) return undefined;
  return `fell behind ${times === 1 ? 'once' : `${times} times`}`;
}

export function speedName(factor: number): string {
  return factor === SPEED_MAX ? `${speed(factor)} max` : speed(factor);
}
