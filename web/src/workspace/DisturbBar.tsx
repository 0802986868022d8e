// Disturbances by button: a kick, a push, a blind tracker.

import { For, createSignal, type JSX } from 'solid-js';
import { DIRECTIONS, blind, kick, push, unitVector, type Direction } from '../disturb';
import type { Lab } from '../lab';
import type { Disturbance } from '../protocol.gen';

/** The server's limits, in shown units. */
const MOST_KICK_MN_S = 2;
const MOST_PUSH_MN = 10;
const MOST_SECONDS = 60;

function Amount(props: {
  name: string;
  unit: string;
  most: number;
  value: number;
  disabled: boolean;
  onValue: (value: number) => void;
}): JSX.Element {
  return (
    <label class="amount">
      <input
        type="number"
        class="number"
        aria-label={props.name}
        min="0.01"
        max={props.most}
        step="any"
        required
        value={props.value}
        disabled={props.disabled}
        onInput={(event) => {
          props.onValue(event.currentTarget.valueAsNumber);
        }}
      />
      <span class="unit">{props.unit}</span>
    </label>
  );
}

export function DisturbBar(props: { lab: Lab; id: string }): JSX.Element {
  const { lab } = props;
  const [direction, setDirection] = createSignal<Direction>('random');
  const [kick_mn_s, setKick] = createSignal(1);
  const [push_mn, setPush] = createSignal(2);
  const [push_s, setPushTime] = createSignal(1);
  const [blind_s, setBlindTime] = createSignal(1);
  const disabled = (): boolean => !lab.canOperate();
  const toward = (): readonly [number, number] => unitVector(direction(), Math.random());

  /** A form each, so that Enter in a field does what its button does, and the browser checks the range. */
  const form = (
    fields: JSX.Element,
    button: string,
    disturbance: () => Disturbance,
  ): JSX.Element => (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        lab.send({ type: 'disturb', disturbance: disturbance() });
      }}
    >
      <button type="submit" class="small" disabled={disabled()}>
        {button}
      </button>
      {fields}
    </form>
  );

  return (
    <div id={props.id} class="disturb" role="group" aria-label="Disturb the bead">
      <label class="amount">
        <span class="unit">toward</span>
        <select
          aria-label="Direction of kick and push"
          disabled={disabled()}
          onChange={(event) => setDirection(event.currentTarget.value as Direction)}
        >
          <For each={DIRECTIONS}>{([id, label]) => <option value={id}>{label}</option>}</For>
        </select>
      </label>
      {form(
        <Amount
          name="Strength of the kick in mN·s"
          unit="mN·s"
          most={MOST_KICK_MN_S}
          value={kick_mn_s()}
          disabled={disabled()}
          onValue={setKick}
        />,
        'Kick',
        () => kick(kick_mn_s(), toward()),
      )}
      {form(
        <>
          <Amount
            name="Force of the push in mN"
            unit="mN"
            most={MOST_PUSH_MN}
            value={push_mn()}
            disabled={disabled()}
            onValue={setPush}
          />
          <Amount
            name="Duration of the push in seconds"
            unit="s"
            most={MOST_SECONDS}
            value={push_s()}
            disabled={disabled()}
            onValue={setPushTime}
          />
        </>,
        'Push',
        () => push(push_mn(), push_s(), toward()),
      )}
      {form(
        <Amount
          name="Duration of the blindness in seconds"
          unit="s"
          most={MOST_SECONDS}
          value={blind_s()}
          disabled={disabled()}
          onValue={setBlindTime}
        />,
        'Blind tracker',
        () => blind(blind_s()),
      )}
    </div>
  );
}
