// The disturbances of the scenario: its script and the number of random ones.

import { Dices, X } from 'lucide';
import { Show, createEffect, createMemo, createSignal, on, type JSX } from 'solid-js';
import { describe, describeWhen, MAX_RANDOM, restart } from '../../lab/disturbance';
import { CommandButton } from '../../lab/CommandButton';
import { type ClientMessage, SCRIPT_LIMIT, type Scripted } from '../../net/protocol.gen';
import type { Session, Trial } from '../../lab/slices';
import { NumberField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { numberOf } from '../../ui/fields/number';
import { Icon } from '../../ui/Icon';
import { type Column, Table } from '../../ui/Table';

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
  const timeOf = ({ at }: Scripted): string => describeWhen(at, lab.scene()?.tick_s ?? 0);
  const columns: readonly Column<Scripted>[] = [
    { name: 'When', isHead: true, cell: timeOf },
    { name: 'What', cell: ({ disturbance }) => describe(disturbance) },
    {
      name: 'Remove',
      hideName: true,
      cell: (entry) => (
        <CommandButton
          lab={lab}
          at="workspace"
          class="ghost icon-only small"
          aria-label={`Remove and restart: ${timeOf(entry)}: ${describe(entry.disturbance)}`}
          title="Remove from the script and restart"
          command={() => load({ script: script().filter((one) => one !== entry) })}
        >
          <Icon of={X} />
        </CommandButton>
      ),
    },
  ];
  const [isAdding, setAdding] = createSignal(false);
  return (
    <section class="script">
      <h3>
        Script{' '}
        <span class="number">
          {script().length} of {SCRIPT_LIMIT}
        </span>
      </h3>
      <Show
        when={script().length > 0}
        fallback={<p class="hint">Choose another time above to add a disturbance to the script.</p>}
      >
        <Table class="script-table" label="Script" columns={columns} rows={script()} />
      </Show>
      <Show
        when={isAdding() || inForce() > 0}
        fallback={
          <button type="button" onClick={() => setAdding(true)}>
            <Icon of={Dices} />
            Add random moves…
          </button>
        }
      >
        <Form
          class="random"
          send={async () => {
            const message = load({ disturbances: numberOf(random()) });
            if (message) await lab.send('workspace', message);
          }}
          button="Set and restart"
          buttonClass=""
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
      </Show>
    </section>
  );
}
