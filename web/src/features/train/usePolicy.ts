// Lets a policy carry the bead in the live session.

import type { Session, Trial } from '../../lab/slices';

/** On the present map if the policy was trained on it, otherwise on the first of its maps that the server has. */
export function mapFor(
  trained: readonly string[],
  present: string,
  all: readonly string[],
): string {
  if (trained.includes(present)) return present;
  return trained.find((map) => all.includes(map)) ?? present;
}

export function usePolicy(
  lab: Session & Trial,
  reference: string,
  trained: readonly string[],
): void {
  const scene = lab.scene();
  if (!scene) return;
  const map = mapFor(trained, scene.map, scene.maps);
  if (map === scene.map) {
    lab.edits.edit({ rl_policy: reference });
    lab.send({ type: 'select_controller', controller: 'rl' });
    return;
  }
  lab.send({
    type: 'load_scenario',
    map,
    controller: 'rl',
    seed: scene.seed,
    parameters: { ...scene.parameters, rl_policy: reference },
  });
}
