// The disturbances of the scenario: its script and the number of random ones.

import { For, Show, createEffect, createMemo, createSignal, on, type JSX } from 'solid-js';
import { describe, describeWhen, MAX_RANDOM, restart } from '../../lab/disturbance';
import { CommandButton } from '../../lab/CommandButton';
import type { ClientMessage, Scripted } from '../../net/protocol.gen';
import { Amount } from './disturbFields';
import type { Session, Trial } from '../../lab/slices';

export function ScriptList(props: { lab: Session & Trial }): JSX.Element {
  const { lab } = props;
  const script = (): readonly Scripted[] => lab.scene()?.scenario.script ?? [];
  // A memo: another scene with the same number, as after a rewind, keeps what the user has typed.
  const inForce = createMemo(() => lab.scene()?.scenario.disturbances ?? 0);
  const [random, setRandom] = createSignal(inForce());
  createEffect(on(inForce, setRandom));
  const load = (change: Parameters<typeof restart>[2]): ClientMessage | undefined => {
    const scene = lab.scene();
    const state = lab.state();
    return scene && state && restart(scene, state, change);
  };
  const words = ({ at, disturbance }: Scripted): string =>
    `${describeWhen(at, lab.scene()?.tick_s ?? 0)}: ${describe(disturbance)}`;
  return (
    <div class="script">
      <form
        class="random"
        onSubmit={(event) => {
          event.preventDefault();
          const message = load({ disturbances: random() });
          if (message) void lab.send('workspace', message);
        }}
      >
        <Amount
          name="Number of random moves"
          unit="random moves while the bead is carried"
          min={0}
          max={MAX_RANDOM}
          whole
          value={random()}
          disabled={!lab.canOperate()}
          onValue={setRandom}
        />
        <button
          type="submit"
          class="small"
          disabled={!lab.canOperate() || random() === inForce()}
          title="The trial restarts with the same seed"
        >
          Set and restart
        </button>
      </form>
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
