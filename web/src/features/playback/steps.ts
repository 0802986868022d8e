// Speeds and steps of simulated time. Pure.

import { fixed, speed } from '../../ui/format';
import { CONTROL_PERIOD_S, SPEED_MAX } from '../../net/protocol.gen';

export const SPEEDS: readonly number[] = [0.125, 0.25, 0.5, 1, 2, 4, 8, SPEED_MAX];
/** Below this share of what was asked, the machine is at its limit. */
const LIMITED = 0.85;

/** The next higher (1) or lower (−1) speed; the same at the end of the list. */
export function nextSpeed(target: number, direction: 1 | -1): number {
  const further = SPEEDS.filter((factor) => (factor - target) * direction > 0);
  return (direction > 0 ? further[0] : further.at(-1)) ?? target;
}

/** Ticks to the next one at which a control step is due. */
export function ticksToControlStep(tick: number, tick_s: number): number {
  const stepsBefore = Math.floor((tick * tick_s) / CONTROL_PERIOD_S + 1e-9);
  const due = Math.ceil(((stepsBefore + 1) * CONTROL_PERIOD_S) / tick_s - 1e-9);
  return due - tick;
}

/** What is achieved, and whether it is clearly less than what was asked; 0 before anything was measured. */
export function achievedWords(
  target: number,
  achieved: number,
): { text: string; limited: boolean } {
  if (achieved === 0) return { text: 'achieved –', limited: false };
  const limited = achieved < LIMITED * target;
  return { text: `achieved ${fixed(achieved, achieved < 10 ? 2 : 1)}×`, limited };
}

/** Ticks come every 8 ms; what is later than two of them is worth a word. */
const LATE_MS = 20;

export function lateWords(lateness_ms: number): string | undefined {
  return lateness_ms > LATE_MS ? `${Math.round(lateness_ms)} ms late` : undefined;
}

/** How often the session fell so far behind that it did not catch up. */
export function lostWords(times: number): string | undefined {
  if (times === 0) return undefined;
  return `${times === 1 ? 'once' : `${times} times`} lost time was let go`;
}

export function speedName(factor: number): string {
  return factor === SPEED_MAX ? `max (${speed(factor)})` : speed(factor);
}
