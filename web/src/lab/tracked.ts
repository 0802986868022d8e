// The distance e between the tool and the bead as the tracker knows it.

import { centimetres } from '../ui/format';
import type { Events, Trial } from './slices';

type TrackedLab = Pick<Trial, 'state'> & Pick<Events, 'marks'>;

/** Whether the bead was moved while paused: the tracker measures it in the next tick. */
export function isUnseen(lab: TrackedLab): boolean {
  const state = lab.state();
  if (!state || state.running) return false;
  return lab
    .marks()
    .some(
      ({ tick, what: { code } }) =>
        tick === state.tick && (code === 'placed' || code === 'displaced'),
    );
}

/** `–` while it is not known. */
export const trackedWords = (lab: TrackedLab): string =>
  isUnseen(lab) ? '–' : centimetres(lab.state()?.tracked_error_m ?? NaN);
