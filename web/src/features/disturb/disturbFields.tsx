// The fields of a disturbance: numbers with units, choices, and places that can be picked in the plan view.

import { For, Show, onCleanup, type JSX } from 'solid-js';
import type { Picker } from '../../plan/interaction';
import type { Vec2 } from '../../lab/geometry';
import { numberOf } from '../../ui/number';
import { NumberInput } from '../../ui/NumberInput';

export function Amount(props: {
  name: string;
  /** Text before the number. */
  lead?: string;
  unit?: string;
  min?: number;
  max: number;
  /** Whole numbers only. */
  whole?: boolean;
  value: number;
  disabled: boolean;
  onValue: (value: number) => void;
}): JSX.Element {
  return (
    <label class="amount">
      <Show when={props.lead}>
        <span class="unit">{props.lead}</span>
      </Show>
      <NumberInput
        label={props.name}
        min={props.min ?? 0.01}
        max={props.max}
        isWhole={props.whole}
        isStrict
        value={props.value}
        disabled={props.disabled}
        onInput={(text) => {
          props.onValue(numberOf(text));
        }}
      />
      <Show when={props.unit}>
        <span class="unit">{props.unit}</span>
      </Show>
    </label>
  );
}

export function Choice<T extends string>(props: {
  name: string;
  options: readonly (readonly [T, string])[];
  value: T;
  disabled: boolean;
  onValue: (value: T) => void;
}): JSX.Element {
  return (
    <select
      aria-label={props.name}
      disabled={props.disabled}
      onChange={(event) => {
        props.onValue(event.currentTarget.value as T);
      }}
    >
      <For each={props.options}>
        {([id, label]) => (
          <option value={id} selected={props.value === id}>
            {label}
          </option>
        )}
      </For>
    </select>
  );
}

export interface Place {
  readonly x_m: number;
  readonly y_m: number;
}

/** Names are `x of NAME in metres` and so on. */
export function PlaceFields(props: {
  name: string;
  value: Place;
  disabled: boolean;
  picker: Picker;
  onValue: (value: Place) => void;
}): JSX.Element {
  let button!: HTMLButtonElement;
  const rounded = (value: number): number => Number(value.toFixed(3));
  const take = ([x_m, y_m]: Vec2): void => {
    props.onValue({ x_m: rounded(x_m), y_m: rounded(y_m) });
    button.focus();
  };
  const isPicking = (): boolean => props.picker.isFor(take);
  onCleanup(() => {
    if (isPicking()) props.picker.cancel();
  });
  return (
    <>
      <Amount
        name={`x of ${props.name} in metres`}
        lead="x"
        min={-10}
        max={10}
        value={props.value.x_m}
        disabled={props.disabled}
        onValue={(x_m) => {
          props.onValue({ ...props.value, x_m });
        }}
      />
      <Amount
        name={`y of ${props.name} in metres`}
        lead="y"
        unit="m"
        min={-10}
        max={10}
        value={props.value.y_m}
        disabled={props.disabled}
        onValue={(y_m) => {
          props.onValue({ ...props.value, y_m });
        }}
      />
      <button
        ref={button}
        type="button"
        class="small"
        aria-pressed={isPicking()}
        aria-label={`Pick ${props.name} on the map`}
        title="Click here, then click the place on the map"
        disabled={props.disabled}
        onClick={() => {
          if (isPicking()) {
            props.picker.cancel();
            return;
          }
          props.picker.start(take);
          document.querySelector<HTMLElement>('.stage-canvas')?.focus();
        }}
      >
        Pick
      </button>
    </>
  );
}
