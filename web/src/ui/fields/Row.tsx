// The frame of a field: label, help, unit, and what is wrong with it.

import { Show, createEffect, createUniqueId, on, type JSX } from 'solid-js';
import { joinForm } from './Form';
import { Help } from './Help';

export interface FieldProps {
  readonly label: string;
  /** The accessible name, if it says more than the label. */
  readonly fullName?: string;
  readonly hideLabel?: boolean;
  /** What it fills in, in the request. */
  readonly name?: string;
  /** Further names of that. */
  readonly also?: readonly string[];
  readonly unit?: string;
  readonly help?: string | undefined;
  readonly disabled?: boolean;
  /** Whether it is marked, as different from its default. */
  readonly isChanged?: boolean;
}

/** Attributes of the input. */
export interface InputProps {
  readonly id: string;
  readonly disabled: boolean;
  readonly 'aria-label': string | undefined;
  readonly 'aria-invalid': boolean;
  readonly 'aria-describedby': string | undefined;
}

type FrameProps = FieldProps & {
  /** What is wrong with its value, before it is sent. */
  fault?: string | undefined;
  /** The same, when the form is sent. */
  check?: () => string | undefined;
  /** Below the input. */
  below?: JSX.Element;
  /** An edit mends it. */
  value: unknown;
  children: (input: InputProps) => JSX.Element;
};

function createParts(props: FrameProps) {
  const id = createUniqueId();
  const form = joinForm({
    names: [props.name ?? '', ...(props.also ?? [])],
    get label() {
      return props.label;
    },
    check: () => props.check?.(),
  });
  createEffect(on(() => props.value, form.mend, { defer: true }));
  const refusal = (): string | undefined => props.fault ?? form.refusal();
  const about = (): string | undefined => {
    if (refusal() !== undefined) return `${id}-refusal`;
    const parts = [props.unit && `${id}-unit`, props.help && `${id}-help`];
    return parts.filter(Boolean).join(' ') || undefined;
  };
  const input: InputProps = {
    id,
    get disabled() {
      return props.disabled ?? false;
    },
    get 'aria-label'() {
      return props.fullName;
    },
    get 'aria-invalid'() {
      return refusal() !== undefined;
    },
    get 'aria-describedby'() {
      return about();
    },
  };
  return {
    input,
    help: (
      <Show when={props.help}>
        {(text) => <Help id={`${id}-help`} of={props.fullName ?? props.label} text={text()} />}
      </Show>
    ),
    refusal: (
      <p id={`${id}-refusal`} class="refusal" role="alert">
        {refusal()}
      </p>
    ),
  };
}

/** One input. */
export function Row(props: FrameProps): JSX.Element {
  const { input, help, refusal } = createParts(props);
  return (
    <div class="form-row" classList={{ changed: props.isChanged }}>
      <span class="form-label">
        <label for={input.id} classList={{ 'visually-hidden': props.hideLabel }}>
          {props.label}
        </label>
        {help}
      </span>
      <span class="form-value">
        {props.children(input)}
        <Show when={props.unit}>
          {(unit) => (
            <span id={`${input.id}-unit`} class="unit">
              {unit()}
            </span>
          )}
        </Show>
      </span>
      {props.below}
      {refusal}
    </div>
  );
}

/** Several inputs that answer one question. */
export function Group(props: FrameProps): JSX.Element {
  const { input, help, refusal } = createParts(props);
  return (
    <div
      class="form-group"
      role="group"
      aria-labelledby={input.id}
      aria-describedby={input['aria-describedby']}
    >
      <span class="form-label">
        <span id={input.id} classList={{ 'visually-hidden': props.hideLabel }}>
          {props.label}
        </span>
        {help}
      </span>
      <div class="form-parts">{props.children(input)}</div>
      {refusal}
    </div>
  );
}
