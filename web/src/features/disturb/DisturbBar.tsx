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
import { Amount, Choice, type Place, PlaceFields } from './disturbFields';
import type { Picker } from '../../plan/interaction';
import type { Session, Trial } from '../../lab/slices';
import './disturb.css';

/** One hour. */
const LATEST_S = 3600;
const FARTHEST_CM = 100;

export function DisturbBar(props: {
  lab: Session & Trial;
  id: string;
  picker: Picker;
}): JSX.Element {
  const { lab } = props;
  const { bead_m } = lab.state() ?? { bead_m: [0, 0] };
  const here: Place = { x_m: Number(bead_m[0].toFixed(3)), y_m: Number(bead_m[1].toFixed(3)) };
  const [kind, setKind] = createSignal<Kind>('kick');
  const [time, setTime] = createSignal<Time>('now');
  const [direction, setDirection] = createSignal<Direction>('random');
  const [kick_mn_s, setKick] = createSignal(1);
  const [push_mn, setPush] = createSignal(2);
  const [for_s, setFor] = createSignal(1);
  const [target, setTarget] = createSignal(here);
  const [time_s, setTimeS] = createSignal(5);
  const [step, setStep] = createSignal(30);
  const [passes_m, setPasses] = createSignal(0);
  const [near, setNear] = createSignal(here);
  const [within_cm, setWithin] = createSignal(2);
  onCleanup(() => {
    props.picker.cancel();
  });

  const disabled = (): boolean => !lab.canOperate();
  const isFull = (): boolean => (lab.scene()?.scenario.script.length ?? 0) >= SCRIPT_LIMIT;
  const toward = (): readonly [number, number] => unitVector(direction(), Math.random());
  const disturbance = (): Disturbance => {
    switch (kind()) {
      case 'kick':
        return kick(kick_mn_s(), toward());
      case 'push':
        return push(push_mn(), for_s(), toward());
      case 'move':
        return move(target().x_m, target().y_m);
      case 'blind':
        return blind(for_s());
    }
  };
  /** Undefined means now. */
  const when = (): When | undefined => {
    switch (time()) {
      case 'now':
        return undefined;
      case 'time':
        return { tick: Math.round(time_s() / (lab.scene()?.tick_s ?? 1)) };
      case 'step':
        return { step: step() };
      case 'passes':
        return { passes_x_m: passes_m() };
      case 'near':
        return { near: { ...near(), within_m: within_cm() / 100 } };
    }
  };
  const submit = (): void => {
    const scene = lab.scene();
    const state = lab.state();
    if (!scene || !state) return;
    const at = when();
    if (!at) {
      lab.send({ type: 'disturb', disturbance: disturbance() });
      return;
    }
    const script = [...scene.scenario.script, { at, disturbance: disturbance() }];
    lab.send(restart(scene, state, { script }));
  };
  const button = (): string => {
    const name = KINDS.find(([id]) => id === kind())?.[1] ?? '';
    return time() === 'now' ? `${name} now` : 'Add to script and restart';
  };

  return (
    <div id={props.id} class="disturb" role="group" aria-label="Disturb the bead">
      <form
        onSubmit={(event) => {
          event.preventDefault();
          submit();
        }}
      >
        <Choice
          name="Kind of disturbance"
          options={KINDS}
          value={kind()}
          disabled={disabled()}
          onValue={setKind}
        />
        <Switch>
          <Match when={kind() === 'kick'}>
            <Amount
              name="Strength of the kick in mN·s"
              unit="mN·s"
              max={1000 * MOST_IMPULSE_N_S}
              value={kick_mn_s()}
              disabled={disabled()}
              onValue={setKick}
            />
          </Match>
          <Match when={kind() === 'push'}>
            <Amount
              name="Force of the push in mN"
              unit="mN"
              max={1000 * MOST_DRIFT_N}
              value={push_mn()}
              disabled={disabled()}
              onValue={setPush}
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
          <Choice
            name="Direction of kick and push"
            options={DIRECTIONS}
            value={direction()}
            disabled={disabled()}
            onValue={setDirection}
          />
        </Show>
        <Show when={kind() === 'push' || kind() === 'blind'}>
          <Amount
            name={
              kind() === 'push'
                ? 'Duration of the push in seconds'
                : 'Duration of the blindness in seconds'
            }
            unit="s"
            max={MOST_SECONDS}
            value={for_s()}
            disabled={disabled()}
            onValue={setFor}
          />
        </Show>
        <Choice
          name="Time of the disturbance"
          options={TIMES}
          value={time()}
          disabled={disabled()}
          onValue={setTime}
        />
        <Switch>
          <Match when={time() === 'time'}>
            <Amount
              name="Time in seconds"
              unit="s"
              min={0}
              max={LATEST_S}
              value={time_s()}
              disabled={disabled()}
              onValue={setTimeS}
            />
          </Match>
          <Match when={time() === 'step'}>
            <Amount
              name="Control step on the way to a goal"
              unit="of ¼ s"
              min={1}
              max={MOST_STEPS}
              whole
              value={step()}
              disabled={disabled()}
              onValue={setStep}
            />
          </Match>
          <Match when={time() === 'passes'}>
            <Amount
              name="x that the bead passes, in metres"
              unit="m"
              min={-10}
              max={10}
              value={passes_m()}
              disabled={disabled()}
              onValue={setPasses}
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
            <Amount
              name="Distance from the place in cm"
              lead="within"
              unit="cm"
              min={0.1}
              max={FARTHEST_CM}
              value={within_cm()}
              disabled={disabled()}
              onValue={setWithin}
            />
          </Match>
        </Switch>
        <button
          type="submit"
          class="small primary"
          disabled={disabled() || (time() !== 'now' && isFull())}
          title={
            time() === 'now'
              ? undefined
              : 'The script is part of the experiment: the trial restarts with the same map, seed, start, controller, parameters and goal'
          }
        >
          {button()}
        </button>
      </form>
      <ScriptList lab={lab} />
    </div>
  );
}
