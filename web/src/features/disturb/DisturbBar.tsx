// Disturbances by button: a kick, a push, a move, a blind tracker. They happen now or are added to the script.

import { Match, Show, Switch, createSignal, onCleanup, type JSX } from 'solid-js';
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
import type { Session, Trial } from '../../lab/slices';
import { ChoiceField, NumberField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { numberOf } from '../../ui/fields/number';
import './disturb.css';

/** One hour. */
const LATEST_S = 3600;
const FARTHEST_CM = 100;
/** Of a strength, force or duration, in the shown unit. */
const LEAST = 0.01;

export function DisturbBar(props: {
  lab: Session & Trial;
  id: string;
  picker: Picker;
}): JSX.Element {
  const { lab } = props;
  const { bead_m } = lab.state() ?? { bead_m: [0, 0] };
  const here = placeAt(bead_m[0], bead_m[1]);
  const [kind, setKind] = createSignal<Kind>('kick');
  const [time, setTime] = createSignal<Time>('now');
  const [direction, setDirection] = createSignal<Direction>('random');
  const [kick_mn_s, setKick] = createSignal('1');
  const [push_mn, setPush] = createSignal('2');
  const [for_s, setFor] = createSignal('1');
  const [target, setTarget] = createSignal<Place>(here);
  const [time_s, setTimeS] = createSignal('5');
  const [step, setStep] = createSignal('30');
  const [passes_m, setPasses] = createSignal('0');
  const [near, setNear] = createSignal<Place>(here);
  const [within_cm, setWithin] = createSignal('2');
  onCleanup(() => {
    props.picker.cancel();
  });

  const disabled = (): boolean => !lab.canOperate();
  const isFull = (): boolean => (lab.scene()?.scenario.script.length ?? 0) >= SCRIPT_LIMIT;
  const toward = (): readonly [number, number] => unitVector(direction(), Math.random());
  const disturbance = (): Disturbance => {
    switch (kind()) {
      case 'kick':
        return kick(numberOf(kick_mn_s()), toward());
      case 'push':
        return push(numberOf(push_mn()), numberOf(for_s()), toward());
      case 'move':
        return move(numberOf(target().x_m), numberOf(target().y_m));
      case 'blind':
        return blind(numberOf(for_s()));
    }
  };
  /** Undefined means now. */
  const when = (): When | undefined => {
    switch (time()) {
      case 'now':
        return undefined;
      case 'time':
        return { tick: Math.round(numberOf(time_s()) / (lab.scene()?.tick_s ?? 1)) };
      case 'step':
        return { step: numberOf(step()) };
      case 'passes':
        return { passes_x_m: numberOf(passes_m()) };
      case 'near':
        return {
          near: {
            x_m: numberOf(near().x_m),
            y_m: numberOf(near().y_m),
            within_m: numberOf(within_cm()) / 100,
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

  return (
    <div id={props.id} class="disturb" role="group" aria-label="Disturb the bead">
      <Form
        class="disturb-form"
        isInline
        send={submit}
        button={button()}
        buttonClass="small primary"
        buttonTitle={
          time() === 'now'
            ? undefined
            : 'The script is part of the experiment: the trial restarts with the same map, seed, start, controller, parameters and goal'
        }
        disabled={disabled() || (time() !== 'now' && isFull())}
        why={isFull() ? `The script is full: ${SCRIPT_LIMIT} entries.` : undefined}
      >
        <ChoiceField
          hideLabel
          label="Kind of disturbance"
          options={KINDS}
          value={kind()}
          disabled={disabled()}
          onChoose={setKind}
        />
        <Switch>
          <Match when={kind() === 'kick'}>
            <NumberField
              hideLabel
              label="Strength of the kick in mN·s"
              unit="mN·s"
              min={LEAST}
              max={1000 * MOST_IMPULSE_N_S}
              value={kick_mn_s()}
              disabled={disabled()}
              onInput={setKick}
            />
          </Match>
          <Match when={kind() === 'push'}>
            <NumberField
              hideLabel
              label="Force of the push in mN"
              unit="mN"
              min={LEAST}
              max={1000 * MOST_DRIFT_N}
              value={push_mn()}
              disabled={disabled()}
              onInput={setPush}
            />
          </Match>
          <Match when={kind() === 'move'}>
            <PlaceFields
              name="the new place"
              value={target()}
              disabled={disabled()}
              picker={props.picker}
              onValue={setTarget}
            />
          </Match>
        </Switch>
        <Show when={kind() === 'kick' || kind() === 'push'}>
          <ChoiceField
            hideLabel
            label="Direction of kick and push"
            options={DIRECTIONS}
            value={direction()}
            disabled={disabled()}
            onChoose={setDirection}
          />
        </Show>
        <Show when={kind() === 'push' || kind() === 'blind'}>
          <NumberField
            hideLabel
            label={
              kind() === 'push'
                ? 'Duration of the push in seconds'
                : 'Duration of the blindness in seconds'
            }
            unit="s"
            min={LEAST}
            max={MOST_SECONDS}
            value={for_s()}
            disabled={disabled()}
            onInput={setFor}
          />
        </Show>
        <ChoiceField
          hideLabel
          label="Time of the disturbance"
          options={TIMES}
          value={time()}
          disabled={disabled()}
          onChoose={setTime}
        />
        <Switch>
          <Match when={time() === 'time'}>
            <NumberField
              hideLabel
              label="Time in seconds"
              unit="s"
              min={0}
              max={LATEST_S}
              value={time_s()}
              disabled={disabled()}
              onInput={setTimeS}
            />
          </Match>
          <Match when={time() === 'step'}>
            <NumberField
              hideLabel
              label="Control step on the way to a goal"
              unit="of ¼ s"
              min={1}
              max={MOST_STEPS}
              isWhole
              value={step()}
              disabled={disabled()}
              onInput={setStep}
            />
          </Match>
          <Match when={time() === 'passes'}>
            <NumberField
              hideLabel
              label="x that the bead passes, in metres"
              unit="m"
              min={-10}
              max={10}
              value={passes_m()}
              disabled={disabled()}
              onInput={setPasses}
            />
          </Match>
          <Match when={time() === 'near'}>
            <PlaceFields
              name="the place to reach"
              value={near()}
              disabled={disabled()}
              picker={props.picker}
              onValue={setNear}
            />
            <NumberField
              label="within"
              fullName="Within this distance of the place in cm"
              unit="cm"
              min={0.1}
              max={FARTHEST_CM}
              value={within_cm()}
              disabled={disabled()}
              onInput={setWithin}
            />
          </Match>
        </Switch>
      </Form>
      <ScriptList lab={lab} />
    </div>
  );
}
