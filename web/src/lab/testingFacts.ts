// Facts for the unit tests.

import type { EventMessage, Happening, PhaseFact, StopCode, Told } from '../net/protocol.gen';

type Plain = Exclude<PhaseFact['code'], 'stopped'>;

export const phaseOf = (code: Plain): Told<PhaseFact> => ({ code, text: '' });
export const stoppedBy = (by: StopCode, steps?: number): Told<PhaseFact> => ({
  code: 'stopped',
  by,
  ...(steps === undefined ? {} : { steps }),
  text: '',
});

/** An event with a sentence that says which. */
export const eventAt = (
  tick: number,
  kind: EventMessage['kind'] = 'switch',
  what: Happening = { code: 'took_up', about: `at ${tick}` },
): EventMessage => ({ tick, sim_time_s: tick * 0.008, kind, what: { ...what, text: '' } });
