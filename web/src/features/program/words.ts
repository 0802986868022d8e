// What the page says about a program. Pure.

import type { ProgramStanding } from '../../net/protocol.gen';
import { counted, fixed } from '../../ui/format';
import { shownName } from '../../ui/name';

/** `mine answers in 4 ms; 2 steps without an answer.` */
export function standingWords(program: ProgramStanding): string {
  const { is_connected, missed, latency_s } = program;
  const name = shownName(program.name);
  if (!is_connected) return `${name} is not connected: the arm holds until it is.`;
  const answers =
    latency_s === null ? 'has not been asked yet' : `answers in ${fixed(latency_s * 1000, 0)} ms`;
  const lost = missed === 0 ? '' : `; ${counted(missed, 'step')} without a usable answer`;
  return `${name} ${answers}${lost}.`;
}
