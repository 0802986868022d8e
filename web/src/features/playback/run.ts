// The button Run and the Space key.

import type { Notices, Trial } from '../../lab/slices';
import type { ClientMessage } from '../../net/protocol.gen';

const NO_GOAL = 'No goal is set: choose a free place in the workspace.';

export const runOrPause = (lab: Trial): ClientMessage => ({
  type: lab.state()?.running ? 'pause' : 'run',
});

/** Says why the arm does not move in a run without a goal. */
export function hintAtGoal(lab: Trial & Notices): void {
  const state = lab.state();
  if (state?.running && !state.goal_m) lab.notify('workspace', NO_GOAL);
}
