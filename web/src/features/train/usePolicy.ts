// Lets a policy carry the bead in the live session.

import { loadTrial } from '../../lab/loadTrial';
import type { Notices, Session, Trial } from '../../lab/slices';
import { IS_TOUCH } from '../../ui/touch';
import { mapFor, nextWords, type Policy } from './policyUse';

export async function usePolicy(
  lab: Session & Trial & Notices,
  { name, reference }: Policy,
  trained: readonly string[],
): Promise<void> {
  const scene = lab.scene();
  if (!scene) return;
  const map = mapFor(trained, scene.map, lab.catalog.maps() ?? []);
  const parameters = { ...scene.parameters, rl_policy: reference };
  const answer =
    map === scene.map
      ? await lab.send('workspace', { type: 'configure', parameters })
      : await loadTrial(lab, 'workspace', { map, controller: 'rl', parameters });
  if (answer?.kind !== 'done') return;
  await lab.send('workspace', { type: 'select_controller', controller: 'rl' });
  const state = lab.state();
  const now = { hasGoal: (state?.goal_m ?? null) !== null, running: state?.running ?? false };
  lab.notify('workspace', nextWords(name, now, IS_TOUCH));
}
