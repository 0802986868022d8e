// A select that shows the server's value, also after the server refused a choice.

import { For, createEffect, createUniqueId, on, type JSX } from 'solid-js';

export function TruthSelect(props: {
  label: string;
  /** Whether to hide the label visually, because the first option is clear enough. */
  hideLabel?: boolean;
  value: string;
  options: readonly (readonly [value: string, label: string])[];
  refusals: number;
  disabled: boolean;
  onChoose: (value: string) => void;
}): JSX.Element {
  const id = createUniqueId();
  let select!: HTMLSelectElement;
  createEffect(
    on([() => props.value, () => props.refusals, () => props.options], ([value]) => {
      select.value = value;
    }),
  );
  return (
    <div class="field">
      <label for={id} classList={{ 'visually-hidden': props.hideLabel ?? false }}>
        {props.label}
      </label>
      <select
        ref={select}
        id={id}
        disabled={props.disabled}
        title={props.options.find(([value]) => value === props.value)?.[1]}
        onChange={(event) => {
          props.onChoose(event.currentTarget.value);
        }}
      >
        <For each={props.options}>{([value, label]) => <option value={value}>{label}</option>}</For>
      </select>
    </div>
  );
}
