// The parameters, bound both ways: edits go out whole, and what the server says is shown.

import {
  For,
  Index,
  Show,
  batch,
  createEffect,
  createMemo,
  createSignal,
  on,
  onCleanup,
} from 'solid-js';
import type { JSX } from 'solid-js';
import type { Lab } from '../lab';
import { GROUPS } from '../parameterGroups';
import {
  digits,
  shownMost,
  shownValue,
  storedValue,
  withFollowers,
  type ChoiceField,
  type Field,
  type FlagField,
  type Group,
  type NumberField,
} from '../parameters';
import type { Parameters, SceneMessage } from '../protocol.gen';

/** An edit that the server has not confirmed by then is shown as not made. */
const CONFIRM_MS = 2000;

interface Form {
  /** In force, with edits that are on their way on top. */
  readonly values: () => Parameters;
  readonly defaults: () => Parameters;
  readonly disabled: () => boolean;
  /** Why a field has no effect now, if it has none. */
  readonly idle: (name: keyof Parameters) => string | undefined;
  /** What a slider shows while it is moved. */
  readonly moving: () => Partial<Parameters>;
  readonly move: (change: Partial<Parameters>) => void;
  readonly edit: (change: Partial<Parameters>) => void;
}

function NumberRow(props: { form: Form; field: NumberField }): JSX.Element {
  const { form, field } = props;
  // While a slider moves, its number follows; it goes out when the slider is let go.
  const shown = createMemo(() =>
    shownValue(field, form.moving()[field.name] ?? form.values()[field.name]),
  );
  const max = (): number => shownMost(field, form.values());
  // A memo, so that news of other parameters does not overwrite what is being typed.
  const text = createMemo(() => shown().toFixed(digits(field.step)));
  const stored = (value: number): Partial<Parameters> => ({
    [field.name]: storedValue(field, value, form.values()),
  });
  const commit = (value: number): void => {
    batch(() => {
      form.move({});
      if (Number.isFinite(value)) form.edit(stored(value));
    });
  };
  const id = `parameter-${field.name}`;
  return (
    <div
      class="row"
      classList={{ changed: form.values()[field.name] !== form.defaults()[field.name] }}
    >
      <label for={id} title={field.help}>
        {field.label}
      </label>
      <span class="with-unit">
        <input
          id={id}
          type="number"
          class="number"
          min={field.min}
          max={max()}
          step={field.step}
          value={text()}
          disabled={form.disabled()}
          onChange={(event) => {
            commit(event.currentTarget.valueAsNumber);
            // What was out of range or no number at all must not stay on display.
            event.currentTarget.value = text();
          }}
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
          form.move(stored(event.currentTarget.valueAsNumber));
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

function ChoiceRow(props: { form: Form; field: ChoiceField }): JSX.Element {
  const { form, field } = props;
  const value = (): string => form.values()[field.name];
  const id = `parameter-${field.name}`;
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
        <For each={field.options}>
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
  const id = `parameter-${field.name}`;
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

function FieldRow(props: { form: Form; field: Field }): JSX.Element {
  const { form, field } = props;
  switch (field.kind) {
    case 'number':
      return <NumberRow form={form} field={field} />;
    case 'choice':
      return <ChoiceRow form={form} field={field} />;
    case 'flag':
      return <FlagRow form={form} field={field} />;
  }
}

function GroupBox(props: { form: Form; group: Group }): JSX.Element {
  const { form, group } = props;
  const changed = (): number =>
    group.fields.filter(({ name }) => form.values()[name] !== form.defaults()[name]).length;
  return (
    <details class="group" open={group.open}>
      <summary>
        {group.title}
        <Show when={changed() > 0}>
          <span class="changed-count">{changed()} changed</span>
        </Show>
      </summary>
      <Index each={group.fields}>{(field) => <FieldRow form={form} field={field()} />}</Index>
    </details>
  );
}

/** Edits that are out, by name; they go when the server's parameters agree or it refuses. */
function createForm(lab: Lab, scene: () => SceneMessage): Form {
  const [edits, setEdits] = createSignal<Partial<Parameters>>({});
  const [moving, setMoving] = createSignal<Partial<Parameters>>({});
  let timer: ReturnType<typeof setTimeout> | undefined;
  const drop = (): void => {
    setEdits({});
  };
  createEffect(
    on(
      () => scene().parameters,
      (truth) => {
        const open = Object.entries(edits()).filter(
          ([name, value]) => truth[name as keyof Parameters] !== value,
        );
        setEdits(Object.fromEntries(open));
      },
    ),
  );
  createEffect(on(lab.refusals, drop, { defer: true }));
  createEffect(() => {
    // A slider that is disabled under the hand never says that it was let go.
    if (!lab.canOperate()) setMoving({});
    lab.draft({ ...edits(), ...moving() });
  });
  onCleanup(() => {
    clearTimeout(timer);
  });
  const values = createMemo(() => ({ ...scene().parameters, ...edits() }));
  return {
    values,
    defaults: () => scene().defaults,
    disabled: () => !lab.canOperate(),
    idle: (name) =>
      name === 'tool_orientation' && scene().positioner === 'planar_stage'
        ? 'The planar stage always holds the block upright.'
        : undefined,
    moving,
    move: setMoving,
    edit: (change) => {
      const whole = withFollowers(GROUPS, values(), change);
      // Before the edits, which are part of `values`.
      const parameters: Parameters = { ...values(), ...whole };
      setEdits({ ...edits(), ...whole });
      lab.send({ type: 'configure', parameters });
      clearTimeout(timer);
      timer = setTimeout(drop, CONFIRM_MS);
    },
  };
}

export function ParameterForm(props: { lab: Lab; scene: SceneMessage }): JSX.Element {
  const { lab } = props;
  const form = createForm(lab, () => props.scene);
  const controller = createMemo(() => lab.state()?.controller);
  // Those of other controllers have no effect now.
  const groups = createMemo(() =>
    GROUPS.filter((group) => !group.controller || group.controller === controller()),
  );
  return (
    <div class="parameters">
      <div class="parameters-head">
        <h3>Parameters</h3>
        <button
          type="button"
          class="small"
          disabled={form.disabled()}
          onClick={() => {
            form.edit(props.scene.defaults);
          }}
        >
          Restore defaults
        </button>
      </div>
      <For each={groups()}>{(group) => <GroupBox form={form} group={group} />}</For>
    </div>
  );
}
