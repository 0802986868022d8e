// A select that shows the user's choice until the server has answered it, then the server's value.

import { For, createEffect, createUniqueId, on, type JSX } from 'solid-js';
import { createPending } from './pending';

export function ServerSelect(props: {
  label: string;
  /** Whether to hide the label visually, because the first option is clear enough. */
  hideLabel?: boolean;
  value: string;
  options: readonly (readonly [value: string, label: string])[];
  disabled: boolean;
  onChoose: (value: string) => unknown;
}): JSX.Element {
  const id = createUniqueId();
  const choice = createPending(
    () => props.value,
    (value) => Promise.resolve(props.onChoose(value)),
  );
  let select!: HTMLSelectElement;
  createEffect(
    on([choice.value, () => props.options], ([value]) => {
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
        aria-busy={choice.isPending()}
        title={props.options.find(([value]) => value === choice.value())?.[1]}
        onChange={(event) => choice.choose(event.currentTarget.value)}
      >
        <For each={props.options}>{([value, label]) => <option value={value}>{label}</option>}</For>
      </select>
    </div>
  );
}
