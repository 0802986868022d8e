// One parameter as a row of a form: name, value, input.

import { For, batch, createMemo, createUniqueId, type JSX } from 'solid-js';
import {
  type ChoiceField,
  digits,
  type Field,
  type FlagField,
  type NumberField,
  type PolicyField,
  policyOptions,
  shownMost,
  shownValue,
  storedValue,
} from './parameters';
import type { Parameters, SceneMessage } from '../net/protocol.gen';
import type { Session, Trial } from './slices';
import { NumberInput } from '../ui/NumberInput';
import './ParameterField.css';

export interface Form {
  /** The server's values with pending edits. */
  readonly values: () => Parameters;
  readonly defaults: () => Parameters;
  readonly disabled: () => boolean;
  /** Added policies that can be chosen. */
  readonly policies: () => readonly string[];
  /** Why a field has no effect now; undefined if it has an effect. */
  readonly idle: (name: keyof Parameters) => string | undefined;
  /** The value of a slider while the user moves it. */
  readonly moving: () => Partial<Parameters>;
  readonly move: (change: Partial<Parameters>) => void;
  readonly edit: (change: Partial<Parameters>) => void;
}

function NumberRow(props: { form: Form; field: NumberField }): JSX.Element {
  const { form, field } = props;
  // While a slider moves, its number follows. The value is sent when the slider is released.
  const shown = createMemo(() =>
    shownValue(field, form.moving()[field.name] ?? form.values()[field.name]),
  );
  const max = (): number => shownMost(field, form.values());
  // A memo, so that changes of other parameters do not overwrite what the user types.
  const text = createMemo(() => shown().toFixed(digits(field.step)));
  const stored = (value: number): Partial<Parameters> => ({
    [field.name]: storedValue(field, value, form.values()),
  });
  const commit = (value: number): void => {
    batch(() => {
      form.move({});
      form.edit(stored(value));
    });
  };
  const id = createUniqueId();
  return (
    <div
      class="row"
      classList={{ changed: form.values()[field.name] !== form.defaults()[field.name] }}
    >
      <label for={id} title={field.help}>
        {field.label}
      </label>
      <span class="with-unit">
        <NumberInput
          id={id}
          min={field.min}
          max={max()}
          step={field.step}
          isWhole={field.whole}
          value={text()}
          disabled={form.disabled()}
          // A value out of range becomes the nearest one.
          onNumber={commit}
        />
        <span class="unit">{field.unit}</span>
      </span>
      <input
        type="range"
        aria-label={`${field.label} slider`}
        min={field.min}
        max={max()}
        step={field.step}
        value={shown()}
        disabled={form.disabled()}
        onInput={(event) => {
          const change = stored(event.currentTarget.valueAsNumber);
          // Released where it started: no change event.
          form.move(change[field.name] === form.values()[field.name] ? {} : change);
        }}
        onPointerCancel={() => {
          form.move({});
        }}
        onChange={(event) => {
          commit(event.currentTarget.valueAsNumber);
        }}
      />
    </div>
  );
}

function ChoiceRow(props: {
  form: Form;
  field: ChoiceField | PolicyField;
  options: readonly (readonly [value: string, label: string])[];
}): JSX.Element {
  const { form, field } = props;
  const value = (): string => form.values()[field.name];
  const id = createUniqueId();
  return (
    <div class="row" classList={{ changed: value() !== form.defaults()[field.name] }}>
      <label for={id} title={field.help}>
        {field.label}
      </label>
      <select
        id={id}
        disabled={form.disabled() || form.idle(field.name) !== undefined}
        title={form.idle(field.name)}
        onChange={(event) => {
          form.edit({ [field.name]: event.currentTarget.value });
        }}
      >
        <For each={props.options}>
          {([option, label]) => (
            <option value={option} selected={value() === option}>
              {label}
            </option>
          )}
        </For>
      </select>
    </div>
  );
}

function FlagRow(props: { form: Form; field: FlagField }): JSX.Element {
  const { form, field } = props;
  const value = (): boolean => form.values()[field.name];
  const id = createUniqueId();
  return (
    <div class="row" classList={{ changed: value() !== form.defaults()[field.name] }}>
      <label for={id} title={field.help}>
        {field.label}
      </label>
      <input
        id={id}
        type="checkbox"
        checked={value()}
        disabled={form.disabled()}
        onChange={(event) => {
          form.edit({ [field.name]: event.currentTarget.checked });
        }}
      />
    </div>
  );
}

export function FieldRow(props: { form: Form; field: Field }): JSX.Element {
  const { form, field } = props;
  switch (field.kind) {
    case 'number':
      return <NumberRow form={form} field={field} />;
    case 'choice':
      return <ChoiceRow form={form} field={field} options={field.options} />;
    case 'policy': {
      const options = (): ReturnType<typeof policyOptions> =>
        policyOptions(field, form.policies(), form.values()[field.name]);
      return <ChoiceRow form={form} field={field} options={options()} />;
    }
    case 'flag':
      return <FlagRow form={form} field={field} />;
  }
}

/** A form for the parameters of a scene; all forms of the page share the edits. */
export function createForm(lab: Session & Trial, scene: () => SceneMessage): Form {
  return {
    values: () => lab.edits.values() ?? scene().parameters,
    defaults: () => scene().defaults,
    disabled: () => !lab.canOperate(),
    policies: lab.catalog.addedPolicies,
    idle: (name) =>
      name === 'tool_orientation' && scene().positioner === 'planar_stage'
        ? 'The planar stage always holds the magnet upright.'
        : undefined,
    moving: lab.edits.moving,
    move: (change) => {
      lab.edits.move(change);
    },
    edit: (change) => {
      lab.edits.edit(change);
    },
  };
}
