// Fields of the form, each with its label, its help and its fault.

import { For, Show, createUniqueId, type JSX } from 'solid-js';
import { Fault } from './Fault';
import { NumberInput } from '../../ui/NumberInput';
import type { Steps } from '../../ui/number';

interface FieldProps {
  readonly label: string;
  readonly value: string;
  readonly fault?: string | undefined;
  readonly help?: string | undefined;
  readonly onInput: (value: string) => void;
}

interface Ids {
  readonly id: string;
  /** Of help and fault. */
  readonly about: string;
}

function Field(props: FieldProps & { children: (ids: Ids) => JSX.Element }): JSX.Element {
  const id = createUniqueId();
  return (
    <div class="train-field">
      <label for={id}>{props.label}</label>
      {props.children({ id, about: `${id}-help ${id}-fault` })}
      <p id={`${id}-help`} class="rule" hidden={props.help === undefined}>
        {props.help}
      </p>
      <Fault id={`${id}-fault`} text={props.fault} />
    </div>
  );
}

export function SelectField(
  props: FieldProps & { options: readonly (readonly [value: string, label: string])[] },
): JSX.Element {
  return (
    <Field {...props}>
      {({ id, about }) => (
        <select
          id={id}
          aria-invalid={props.fault !== undefined}
          aria-describedby={about}
          onChange={({ currentTarget }) => {
            props.onInput(currentTarget.value);
          }}
        >
          <For each={props.options}>
            {([value, label]) => (
              <option value={value} selected={value === props.value}>
                {label}
              </option>
            )}
          </For>
        </select>
      )}
    </Field>
  );
}

export function TextField(
  props: FieldProps & {
    maxLength?: number;
    number?: Steps;
  },
): JSX.Element {
  return (
    <Field {...props}>
      {({ id, about }) => (
        <Show
          when={props.number}
          fallback={
            <input
              id={id}
              type="text"
              value={props.value}
              maxLength={props.maxLength}
              autocomplete="off"
              spellcheck={false}
              aria-invalid={props.fault !== undefined}
              aria-describedby={about}
              onInput={({ currentTarget }) => {
                props.onInput(currentTarget.value);
              }}
            />
          }
        >
          {(number) => (
            <NumberInput
              {...number()}
              id={id}
              value={props.value}
              isInvalid={props.fault !== undefined}
              describedBy={about}
              onInput={props.onInput}
            />
          )}
        </Show>
      )}
    </Field>
  );
}
