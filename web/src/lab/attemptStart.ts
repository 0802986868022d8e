// The moment at which the present attempt began.

import type { Events, Trial } from './slices';

/** Tick at which the last goal was set, or the oldest one that is kept. */
export function attemptStart(lab: Pick<Trial, 'state'> & Pick<Events, 'marks'>): number {
  const set = lab.marks().findLast(({ kind }) => kind === 'goal');
  return Math.max(set?.tick ?? 0, lab.state()?.oldest_tick ?? 0);
}
