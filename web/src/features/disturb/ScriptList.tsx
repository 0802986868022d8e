// The disturbances of the scenario: its script and the number of random ones.

import { For, Show, createEffect, createMemo, createSignal, on, type JSX } from 'solid-js';
import { describe, describeWhen, MAX_RANDOM, restart } from '../../lab/disturbance';
import { CommandButton } from '../../lab/CommandButton';
import type { ClientMessage, Scripted } from '../../net/protocol.gen';
import type { Session, Trial } from '../../lab/slices';
import { NumberField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { numberOf } from '../../ui/fields/number';

export function ScriptList(props: { lab: Session & Trial }): JSX.Element {
  const { lab } = props;
  const script = (): readonly Scripted[] => lab.scene()?.scenario.script ?? [];
  // A memo: another scene with the same number, as after a rewind, keeps what the user has typed.
  const inForce = createMemo(() => lab.scene()?.scenario.disturbances ?? 0);
  const [random, setRandom] = createSignal(String(inForce()));
  createEffect(on(inForce, (count) => setRandom(String(count))));
  const load = (change: Parameters<typeof restart>[2]): ClientMessage | undefined => {
    const scene = lab.scene();
    const state = lab.state();
    return scene && state && restart(scene, state, change);
  };
  const words = ({ at, disturbance }: Scripted): string =>
    `${describeWhen(at, lab.scene()?.tick_s ?? 0)}: ${describe(disturbance)}`;
  return (
    <div class="script">
      <Form
        class="random"
        isInline
        send={async () => {
          const message = load({ disturbances: numberOf(random()) });
          if (message) await lab.send('workspace', message);
        }}
        button="Set and restart"
        buttonClass="small"
        buttonTitle="The trial restarts with the same seed"
        disabled={!lab.canOperate() || random() === String(inForce())}
      >
        <NumberField
          name="disturbances"
          label="Number of random moves"
          help="The bead is moved as often while it is carried, at random steps."
          min={0}
          max={MAX_RANDOM}
          isWhole
          value={random()}
          disabled={!lab.canOperate()}
          onInput={setRandom}
        />
      </Form>
      <Show when={script().length > 0}>
        <ol aria-label="Script">
          <For each={script()}>
            {(entry, index) => (
              <li>
                <div>
                  <span>{words(entry)}</span>
                  <CommandButton
                    lab={lab}
                    at="workspace"
                    class="bare"
                    aria-label={`Remove and restart: ${words(entry)}`}
                    title="Remove from the script and restart"
                    command={() => load({ script: script().filter((_, at) => at !== index()) })}
                  >
                    ×
                  </CommandButton>
                </div>
              </li>
            )}
          </For>
        </ol>
      </Show>
    </div>
  );
}
