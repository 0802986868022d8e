// The button Run and the Space key.

import type { Notices, Session, Trial } from '../../lab/slices';

const NO_GOAL = 'No goal is set: choose a free place in the workspace.';

export function runOrPause(lab: Session & Trial & Notices): void {
  const state = lab.state();
  lab.send({ type: state?.running ? 'pause' : 'run' });
  if (!state?.running && !state?.goal_m) lab.notify('workspace', NO_GOAL);
}
