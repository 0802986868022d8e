// The moment at which the present attempt began.

import type { Events, Trial } from './slices';

/** Tick at which the last goal was set; undefined if it is no longer kept. */
export function attemptStart(
  lab: Pick<Trial, 'state'> & Pick<Events, 'marks'>,
): number | undefined {
  const tick = lab.marks().findLast(({ kind }) => kind === 'goal')?.tick ?? 0;
  return tick < (lab.state()?.oldest_tick ?? 0) ? undefined : tick;
}

/** Says why there is nothing to compare. */
export const START_NOT_KEPT = 'The moment at which the goal was set is no longer kept';
