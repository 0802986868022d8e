// What the shipped policies do on a new map, and a press that lets one carry the bead.

import { Check, LoaderCircle, X } from 'lucide';
import { For, Show, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { Icon } from '../../ui/Icon';
import { SmallButton } from '../../ui/SmallButton';
import { type PolicyTrial, solves, TRIALS } from './policyTrials';

function words({ policy, outcome }: PolicyTrial): string {
  switch (outcome.kind) {
    case 'trying':
      return `The shipped policy ${policy} is tried: ${outcome.done} of ${TRIALS} trials.`;
    case 'failed':
      return `The shipped policy ${policy} could not be tried: ${outcome.why}.`;
    case 'tried': {
      const count = `${outcome.delivered} of ${TRIALS} trials`;
      return outcome.delivered === TRIALS
        ? `The shipped policy ${policy} solves this map: ${count}.`
        : `The shipped policy ${policy} does not solve this map: ${count}.`;
    }
  }
}

export function TrialLines(props: {
  lab: Session & Trial;
  trials: readonly PolicyTrial[];
}): JSX.Element {
  const { lab } = props;
  const carry = async (policy: string): Promise<void> => {
    const scene = lab.scene();
    if (!scene) return;
    const parameters = { ...scene.parameters, rl_policy: policy };
    const answer = await lab.send('workspace', { type: 'configure', parameters });
    if (answer.kind === 'done')
      await lab.send('workspace', { type: 'select_controller', controller: 'rl' });
  };
  return (
    <ul class="policy-trials plain" aria-label="Shipped policies on this map">
      <For each={props.trials.map(({ policy }) => policy)}>
        {(policy) => {
          const trial = (): PolicyTrial =>
            props.trials.find((one) => one.policy === policy) ?? {
              policy,
              outcome: { kind: 'trying', done: 0 },
            };
          const icon = () =>
            solves(trial()) ? Check : trial().outcome.kind === 'trying' ? LoaderCircle : X;
          return (
            <li classList={{ good: solves(trial()) }}>
              <Icon of={icon()} />
              <span>{words(trial())}</span>
              <Show when={solves(trial())}>
                <SmallButton
                  title={`RL with the policy ${policy} steers the session`}
                  disabled={!lab.canOperate()}
                  onClick={() => void carry(policy)}
                >
                  Let {policy} carry
                </SmallButton>
              </Show>
            </li>
          );
        }}
      </For>
    </ul>
  );
}
