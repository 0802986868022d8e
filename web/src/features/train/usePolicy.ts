// Lets a policy carry the bead in the live session.

import { createEffect, createRoot } from 'solid-js';
import type { Notices, Session, Trial } from '../../lab/slices';
import { IS_TOUCH } from '../../ui/touch';
import { mapFor, nextWords, type Policy } from './policyUse';

let forget: (() => void) | undefined;

/** Acts once the scene has the policy, when the notices of another trial are dropped. A refusal ends the wait. */
function whenUsed(lab: Session & Trial, map: string, reference: string, act: () => void): void {
  forget?.();
  const refusals = lab.refusals();
  createRoot((dispose) => {
    forget = dispose;
    createEffect(() => {
      const scene = lab.scene();
      if (lab.refusals() !== refusals) dispose();
      else if (scene?.map === map && scene.parameters.rl_policy === reference) {
        dispose();
        act();
      }
    });
  });
}

export function usePolicy(
  lab: Session & Trial & Notices,
  { name, reference }: Policy,
  trained: readonly string[],
): void {
  const scene = lab.scene();
  if (!scene) return;
  const map = mapFor(trained, scene.map, scene.maps);
  const isPresent = map === scene.map;
  if (isPresent) {
    lab.edits.edit({ rl_policy: reference });
    lab.send({ type: 'select_controller', controller: 'rl' });
  } else {
    lab.send({
      type: 'load_scenario',
      map,
      controller: 'rl',
      seed: scene.seed,
      parameters: { ...scene.parameters, rl_policy: reference },
    });
  }
  whenUsed(lab, map, reference, () => {
    // Another trial begins paused and without a goal. Its first state may come later.
    const state = isPresent ? lab.state() : undefined;
    const now = { hasGoal: (state?.goal_m ?? null) !== null, running: state?.running ?? false };
    lab.notify('workspace', nextWords(name, now, IS_TOUCH));
  });
}
