// One parameter as a row of a form.

import { batch, createMemo, type JSX } from 'solid-js';
import {
  digits,
  type Field,
  type NumberField as NumberParameter,
  policyOptions,
  shownMost,
  shownValue,
  storedValue,
} from './parameters';
import type { Parameters, SceneMessage } from '../net/protocol.gen';
import type { Session, Trial } from './slices';
import { ChoiceField, FlagField, NumberField } from '../ui/fields/fields';

export type Form = ReturnType<typeof createForm>;

function NumberRow(props: { form: Form; field: NumberParameter; isChanged: boolean }): JSX.Element {
  const { form, field } = props;
  // While a slider moves, its number follows. The value is sent when the slider is released.
  const shown = createMemo(() =>
    shownValue(field, form.moving()[field.name] ?? form.values()[field.name]),
  );
  // A memo, so that changes of other parameters do not overwrite what the user types.
  const text = createMemo(() => shown().toFixed(digits(field.step)));
  const stored = (value: number): Partial<Parameters> => ({
    [field.name]: storedValue(field, value, form.values()),
  });
  return (
    <NumberField
      {...field}
      isChanged={props.isChanged}
      max={shownMost(field, form.values())}
      value={text()}
      disabled={form.disabled()}
      slider={{
        get value() {
          return shown();
        },
        onMove: (value) => {
          const change = stored(value);
          // Released where it started: no change event.
          form.move(change[field.name] === form.values()[field.name] ? {} : change);
        },
        onCancel: () => form.move({}),
      }}
      // A value out of range becomes the nearest one.
      onNumber={(value) =>
        batch(() => {
          form.move({});
          form.edit(stored(value));
        })
      }
    />
  );
}

export function FieldRow(props: { form: Form; field: Field }): JSX.Element {
  const { form, field } = props;
  const isChanged = (): boolean => form.values()[field.name] !== form.defaults()[field.name];
  switch (field.kind) {
    case 'number':
      return <NumberRow form={form} field={field} isChanged={isChanged()} />;
    case 'flag':
      return (
        <FlagField
          {...field}
          isChanged={isChanged()}
          value={form.values()[field.name]}
          disabled={form.disabled()}
          onChoose={(value) => form.edit({ [field.name]: value })}
        />
      );
    default: {
      const value = (): string => form.values()[field.name];
      const options = (): ReturnType<typeof policyOptions> =>
        field.kind === 'policy' ? policyOptions(field, form.policies(), value()) : field.options;
      return (
        <ChoiceField
          {...field}
          isChanged={isChanged()}
          help={[form.idle(field.name), field.help].filter(Boolean).join(' ')}
          options={options()}
          value={value()}
          disabled={form.disabled() || form.idle(field.name) !== undefined}
          onChoose={(chosen) => form.edit({ [field.name]: chosen })}
        />
      );
    }
  }
}

/** A form for the parameters of a scene; all forms of the page share the edits. */
export function createForm(lab: Session & Trial, scene: () => SceneMessage) {
  return {
    /** The server's values with pending edits. */
    values: () => lab.edits.values() ?? scene().parameters,
    defaults: () => scene().defaults,
    disabled: () => !lab.canOperate(),
    /** Added policies that can be chosen. */
    policies: lab.catalog.addedPolicies,
    /** Why a field has no effect now; undefined if it has an effect. */
    idle: (name: keyof Parameters) =>
      name === 'tool_orientation' && scene().positioner === 'planar_stage'
        ? 'The planar stage always holds the magnet upright.'
        : undefined,
    /** The value of a slider while the user moves it. */
    moving: lab.edits.moving,
    move: lab.edits.move,
    edit: lab.edits.edit,
  };
}
