// The kinds of fields.

import { For, Index, createSignal, type JSX } from 'solid-js';
import { NumberInput } from './NumberInput';
import { numberFault, type Steps } from './number';
import { Group, Row, type FieldProps } from './Row';

export type Option<T extends string = string> = readonly [value: T, label: string];

/** A slider beside the number; both show the same value. */
interface Slider {
  readonly value: number;
  /** While it moves. The number is given when it is released. */
  readonly onMove: (value: number) => void;
  readonly onCancel: () => void;
}

export function NumberField(
  props: FieldProps &
    Steps & {
      value: number | string;
      slider?: Slider;
      /** Each edit, as typed. A form with a number outside its limits is not sent. */
      onInput?: (text: string) => void;
      /** The number, when its edit ends. */
      onNumber?: (value: number) => void;
    },
): JSX.Element {
  const [fault, setFault] = createSignal<string>();
  return (
    <Row
      {...props}
      fault={fault()}
      check={() => props.onInput && numberFault(String(props.value), props)}
      below={
        props.slider && (
          <input
            type="range"
            aria-label={`${props.label} slider`}
            min={props.min}
            max={props.max}
            step={props.step}
            value={props.slider.value}
            disabled={props.disabled}
            onInput={(event) => props.slider?.onMove(event.currentTarget.valueAsNumber)}
            onPointerCancel={() => props.slider?.onCancel()}
            onChange={(event) => props.onNumber?.(event.currentTarget.valueAsNumber)}
          />
        )
      }
    >
      {(input) => (
        <NumberInput
          {...props}
          {...input}
          isStrict={props.onInput !== undefined}
          onFault={setFault}
        />
      )}
    </Row>
  );
}

export function ChoiceField<T extends string>(
  props: FieldProps & {
    value: T;
    options?: readonly Option<T>[];
    /** Further options, under headings. */
    groups?: readonly { readonly title: string; readonly options: readonly Option<T>[] }[];
    onChoose: (value: T) => void;
  },
): JSX.Element {
  // By index: an option that stays is not replaced while the user chooses.
  const list = (options: readonly Option<T>[] | undefined): JSX.Element => (
    <Index each={options}>
      {(option) => (
        <option value={option()[0]} selected={option()[0] === props.value}>
          {option()[1]}
        </option>
      )}
    </Index>
  );
  return (
    <Row {...props}>
      {(input) => (
        <select {...input} onChange={(event) => props.onChoose(event.currentTarget.value as T)}>
          {list(props.options)}
          <For each={props.groups}>
            {({ title, options }) => <optgroup label={title}>{list(options)}</optgroup>}
          </For>
        </select>
      )}
    </Row>
  );
}

export function FlagField(
  props: FieldProps & { value: boolean; onChoose: (value: boolean) => void },
): JSX.Element {
  return (
    <Row {...props}>
      {(input) => (
        <input
          {...input}
          type="checkbox"
          checked={props.value}
          onChange={(event) => props.onChoose(event.currentTarget.checked)}
        />
      )}
    </Row>
  );
}

export function TextField(
  props: FieldProps & {
    value: string;
    maxLength?: number;
    placeholder?: string;
    check?: () => string | undefined;
    onInput: (text: string) => void;
  },
): JSX.Element {
  return (
    <Row {...props}>
      {(input) => (
        <input
          {...input}
          type="text"
          value={props.value}
          maxLength={props.maxLength}
          placeholder={props.placeholder}
          autocomplete="off"
          autocapitalize="off"
          spellcheck={false}
          onInput={(event) => props.onInput(event.currentTarget.value)}
        />
      )}
    </Row>
  );
}

/** Any of a list; it must not be empty. */
export function CheckField<T extends string | number>(
  props: FieldProps & {
    all: readonly T[];
    value: readonly T[];
    text?: (item: T) => string;
    /** Before the text. */
    mark?: (item: T) => JSX.Element;
    /** What is done with them, before each accessible name. */
    verb?: string;
    /** What to choose, if none is. */
    missing?: string;
    onChoose: (chosen: T[]) => void;
  },
): JSX.Element {
  const text = (item: T): string => props.text?.(item) ?? String(item);
  return (
    <Group
      {...props}
      value={String(props.value)}
      check={() => (props.value.length > 0 ? undefined : props.missing)}
    >
      {(input) => (
        <For each={props.all}>
          {(item) => (
            <label>
              <input
                type="checkbox"
                aria-label={props.verb && `${props.verb} ${text(item)}`}
                aria-invalid={input['aria-invalid']}
                checked={props.value.includes(item)}
                disabled={input.disabled}
                onChange={({ currentTarget: { checked } }) =>
                  props.onChoose(
                    props.all.filter((one) => (one === item ? checked : props.value.includes(one))),
                  )
                }
              />
              {props.mark?.(item)}
              {text(item)}
            </label>
          )}
        </For>
      )}
    </Group>
  );
}
