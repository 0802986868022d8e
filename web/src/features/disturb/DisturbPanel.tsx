// Disturbances by button: a kick, a push, a move, a blind tracker. They happen now or are added to the script.

import { Hand, ListPlus } from 'lucide';
import { For, Show, createSignal, onCleanup, type JSX } from 'solid-js';
import {
  blind,
  type Direction,
  DIRECTIONS,
  kick,
  type Kind,
  KINDS,
  move,
  push,
  restart,
  type Time,
  TIMES,
  unitVector,
} from '../../lab/disturbance';
import {
  type Disturbance,
  MOST_DRIFT_N,
  MOST_IMPULSE_N_S,
  MOST_SECONDS,
  MOST_STEPS,
  SCRIPT_LIMIT,
  type When,
} from '../../net/protocol.gen';
import { ScriptList } from './ScriptList';
import { type Place, placeAt, PlaceFields } from './PlaceFields';
import type { Picker } from '../../plan/interaction';
import type { PanelProps } from '../../lab/panel';
import type { Session, Trial } from '../../lab/slices';
import { ChoiceField, NumberField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { numberOf } from '../../ui/fields/number';
import './disturb.css';

/** Of a strength, force or duration, in the shown unit. */
const LEAST = 0.01;

/** Numbers that the form asks for: label, accessible name, unit, smallest and greatest value, and the value at first. */
const NUMBERS = {
  kick_mn_s: [
    'Strength',
    'Strength of the kick in mN·s',
    'mN·s',
    LEAST,
    1000 * MOST_IMPULSE_N_S,
    '1',
  ],
  push_mn: ['Force', 'Force of the push in mN', 'mN', LEAST, 1000 * MOST_DRIFT_N, '2'],
  push_s: ['Duration', 'Duration of the push in seconds', 's', LEAST, MOST_SECONDS, '1'],
  blind_s: ['Duration', 'Duration of the blindness in seconds', 's', LEAST, MOST_SECONDS, '1'],
  time_s: ['Time', 'Time in seconds', 's', 0, 3600, '5'],
  step: ['Step', 'Control step on the way to a goal', 'of ¼ s', 1, MOST_STEPS, '30'],
  passes_m: ['x', 'x that the bead passes, in metres', 'm', -10, 10, '0'],
  within_cm: ['Within', 'Within this distance of the place in cm', 'cm', 0.1, 100, '2'],
} as const;
type NumberName = keyof typeof NUMBERS;

const NUMBERS_OF: Readonly<Record<Kind | Time, readonly NumberName[]>> = {
  kick: ['kick_mn_s'],
  push: ['push_mn', 'push_s'],
  move: [],
  blind: ['blind_s'],
  now: [],
  time: ['time_s'],
  step: ['step'],
  passes: ['passes_m'],
  near: ['within_cm'],
};

export default function DisturbPanel(
  props: PanelProps<Session & Trial> & { picker: Picker },
): JSX.Element {
  const { lab } = props;
  const { bead_m } = lab.state() ?? { bead_m: [0, 0] };
  const here = placeAt(bead_m[0], bead_m[1]);
  const [kind, setKind] = createSignal<Kind>('kick');
  const [time, setTime] = createSignal<Time>('now');
  const [direction, setDirection] = createSignal<Direction>('random');
  const [typed, setTyped] = createSignal<Partial<Record<NumberName, string>>>({});
  const [target, setTarget] = createSignal<Place>(here);
  const [near, setNear] = createSignal<Place>(here);
  onCleanup(() => props.picker.cancel());

  const text = (name: NumberName): string => typed()[name] ?? NUMBERS[name][5];
  const number = (name: NumberName): number => numberOf(text(name));
  const disabled = (): boolean => !lab.canOperate();
  const isFull = (): boolean => (lab.scene()?.scenario.script.length ?? 0) >= SCRIPT_LIMIT;
  const toward = (): readonly [number, number] => unitVector(direction(), Math.random());
  const disturbance = (): Disturbance => {
    switch (kind()) {
      case 'kick':
        return kick(number('kick_mn_s'), toward());
      case 'push':
        return push(number('push_mn'), number('push_s'), toward());
      case 'move':
        return move(numberOf(target().x_m), numberOf(target().y_m));
      case 'blind':
        return blind(number('blind_s'));
    }
  };
  /** Undefined means now. */
  const when = (): When | undefined => {
    switch (time()) {
      case 'now':
        return undefined;
      case 'time':
        return { tick: Math.round(number('time_s') / (lab.scene()?.tick_s ?? 1)) };
      case 'step':
        return { step: number('step') };
      case 'passes':
        return { passes_x_m: number('passes_m') };
      case 'near':
        return {
          near: {
            x_m: numberOf(near().x_m),
            y_m: numberOf(near().y_m),
            within_m: number('within_cm') / 100,
          },
        };
    }
  };
  const submit = (): void => {
    const scene = lab.scene();
    const state = lab.state();
    if (!scene || !state) return;
    const at = when();
    if (!at) {
      void lab.send('workspace', { type: 'disturb', disturbance: disturbance() });
      return;
    }
    const script = [...scene.scenario.script, { at, disturbance: disturbance() }];
    void lab.send('workspace', restart(scene, state, { script }));
  };
  const button = (): string => {
    const name = KINDS.find(([id]) => id === kind())?.[1] ?? '';
    return time() === 'now' ? `${name} now` : 'Add to script and restart';
  };
  const numbers = (choice: () => Kind | Time): JSX.Element => (
    <For each={NUMBERS_OF[choice()]}>
      {(name) => {
        const [label, fullName, unit, min, max] = NUMBERS[name];
        return (
          <NumberField
            label={label}
            fullName={fullName}
            unit={unit}
            min={min}
            max={max}
            isWhole={name === 'step'}
            value={text(name)}
            disabled={disabled()}
            onInput={(value) => setTyped({ ...typed(), [name]: value })}
          />
        );
      }}
    </For>
  );

  return (
    <>
      <p>Drag the bead on the map, or do it exactly:</p>
      <Form
        class="disturb"
        send={submit}
        button={button()}
        icon={time() === 'now' ? Hand : ListPlus}
        buttonTitle={
          time() === 'now'
            ? undefined
            : 'The script is part of the experiment: the trial restarts with the same map, seed, start, controller, parameters and goal'
        }
        disabled={disabled() || (time() !== 'now' && isFull())}
        why={isFull() ? `The script is full: ${SCRIPT_LIMIT} entries.` : undefined}
      >
        <div class="form-two" role="group" aria-label="Disturb the bead">
          <ChoiceField
            label="Kind"
            fullName="Kind of disturbance"
            options={KINDS}
            value={kind()}
            disabled={disabled()}
            onChoose={setKind}
          />
          {numbers(kind)}
          <Show when={kind() === 'move'}>
            <PlaceFields
              name="the new place"
              value={target()}
              disabled={disabled()}
              picker={props.picker}
              onValue={setTarget}
            />
          </Show>
          <Show when={kind() === 'kick' || kind() === 'push'}>
            <ChoiceField
              label="Direction"
              fullName="Direction of kick and push"
              options={DIRECTIONS}
              value={direction()}
              disabled={disabled()}
              onChoose={setDirection}
            />
          </Show>
          <ChoiceField
            label="When"
            fullName="When the disturbance happens"
            options={TIMES}
            value={time()}
            disabled={disabled()}
            onChoose={setTime}
          />
          <Show when={time() === 'near'}>
            <PlaceFields
              name="the place to reach"
              value={near()}
              disabled={disabled()}
              picker={props.picker}
              onValue={setNear}
            />
          </Show>
          {numbers(time)}
        </div>
      </Form>
      <ScriptList lab={lab} />
    </>
  );
}
