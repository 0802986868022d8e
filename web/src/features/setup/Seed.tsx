// The seed of the trial.

import { createEffect, createSignal, on, type JSX } from 'solid-js';
import { Dices } from 'lucide';
import { CommandButton } from '../../lab/CommandButton';
import type { Notices, Session } from '../../lab/slices';
import { Icon } from '../../ui/Icon';
import { NumberInput } from '../../ui/fields/NumberInput';
import { numberFault, numberOf } from '../../ui/fields/number';
import { createPending } from '../../ui/pending';
import './setup.css';

const SEED_LIMIT = 2 ** 32;

export function Seed(props: { lab: Session & Notices; seed: number }): JSX.Element {
  const { lab } = props;
  // As typed. Leaving the field does not reset the trial.
  const [typed, setTyped] = createSignal<string>();
  const show = (): void => setTyped(undefined);
  const seed = createPending(
    () => props.seed,
    (value) => lab.send('playback', { type: 'reset', seed: value }),
  );
  createEffect(on(seed.value, show));
  return (
    <form
      class="field seed"
      onSubmit={(event) => {
        event.preventDefault();
        seed.choose(numberOf(typed() ?? String(props.seed)));
      }}
    >
      <label for="seed">Seed</label>
      <NumberInput
        id="seed"
        min={0}
        isWhole
        isStrict
        value={typed() ?? seed.value()}
        aria-busy={seed.isPending()}
        disabled={!lab.canOperate()}
        title="Enter resets the trial with this seed"
        onInput={setTyped}
        onBlur={() => {
          if (numberFault(typed() ?? '0') === undefined) show();
        }}
      />
      <CommandButton
        lab={lab}
        at="playback"
        class="ghost icon-only"
        aria-label="New seed"
        title="Resets the trial with a random seed"
        command={() => ({ type: 'reset', seed: Math.floor(Math.random() * SEED_LIMIT) })}
      >
        <Icon of={Dices} />
      </CommandButton>
    </form>
  );
}
