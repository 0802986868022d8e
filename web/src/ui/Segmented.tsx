// Two to five exclusive choices side by side: radio buttons, so that arrow keys move between them.

import { For, type JSX } from 'solid-js';
import './Segmented.css';

export interface Segment<T extends string> {
  readonly value: T;
  readonly label: JSX.Element;
  readonly help?: string | undefined;
}

export function Segmented<T extends string>(props: {
  /** The accessible name of the group. */
  label: string;
  /** The name of the radio buttons. */
  name: string;
  value: T;
  segments: readonly Segment<T>[];
  disabled?: boolean;
  isBusy?: boolean;
  onChoose: (value: T) => void;
}): JSX.Element {
  return (
    <fieldset class="segmented" role="radiogroup" aria-label={props.label}>
      <For each={props.segments}>
        {({ value, label, help }) => (
          <label title={help} data-value={value}>
            <input
              type="radio"
              name={props.name}
              value={value}
              checked={props.value === value}
              disabled={props.disabled}
              aria-busy={props.value === value && props.isBusy}
              onChange={() => props.onChoose(value)}
            />
            {label}
          </label>
        )}
      </For>
    </fieldset>
  );
}
