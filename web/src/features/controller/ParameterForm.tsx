// The form of the parameters. Each edit sends all parameters; the form shows the server's values.

import { For, Index, Show, createMemo, type JSX } from 'solid-js';
import {
  BrainCircuit,
  Camera,
  Crosshair,
  Gauge,
  Magnet,
  Route,
  Timer,
  Waves,
  Waypoints,
  type IconNode,
} from 'lucide';
import {
  FIELDS,
  GROUPS,
  PRESET_KINDS,
  presetOf,
  type Field,
  type Group,
  type PresetKind,
} from '../../lab/parameters';
import type { Parameters, SceneMessage } from '../../net/protocol.gen';
import { createForm, FieldRow, type Form } from '../../lab/ParameterField';
import type { Session, Trial } from '../../lab/slices';
import { ChoiceField } from '../../ui/fields/fields';
import { Icon } from '../../ui/Icon';
import './ParameterForm.css';

const ICONS: Readonly<Partial<Record<string, IconNode>>> = {
  RL: BrainCircuit,
  ERRT: Route,
  'Attractor dynamics': Waypoints,
  Switching: Gauge,
  'Speeds and steps': Timer,
  Camera,
  'Magnet and bead': Magnet,
  'Walls and fluid': Waves,
  Tracker: Crosshair,
};

const changedOf = (form: Form, fields: readonly Field[]): number =>
  fields.filter(({ name }) => form.values()[name] !== form.defaults()[name]).length;

function GroupBox(props: { form: Form; group: Group }): JSX.Element {
  const { form, group } = props;
  const changed = (): number => changedOf(form, group.fields);
  return (
    <details class="group" open={group.open}>
      <summary>
        <Show when={ICONS[group.title]}>{(icon) => <Icon of={icon()} />}</Show>
        {group.title}
        <Show when={changed() > 0}>
          <span class="changed-count">{changed()} changed</span>
        </Show>
      </summary>
      <div class="field-columns">
        <Index each={group.fields}>{(field) => <FieldRow form={form} field={field()} />}</Index>
      </div>
    </details>
  );
}

function Preset(props: { form: Form; kind: PresetKind }): JSX.Element {
  const { form, kind } = props;
  const { presets } = kind;
  const index = (): number => presetOf(kind, form.values());
  return (
    <ChoiceField<string>
      label={kind.label}
      help={presets.map((one) => `${one.label}: ${one.help}`).join('\n')}
      value={String(index())}
      options={[
        ...(index() < 0 ? [['-1', 'Changed by hand'] as const] : []),
        ...presets.map(({ label }, at) => [String(at), label] as const),
      ]}
      disabled={form.disabled()}
      onChoose={(at) => form.edit(presets[Number(at)]?.values ?? {})}
    />
  );
}

/** The children stand between the presets and the groups. */
export function ParameterForm(props: {
  lab: Session & Trial;
  scene: SceneMessage;
  /** Parameters that the children show. */
  without?: readonly (keyof Parameters)[];
  children?: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  const form = createForm(lab, () => props.scene);
  const controller = createMemo(() => lab.state()?.controller);
  // Parameters of other controllers have no effect now.
  const groups = createMemo(() =>
    GROUPS.filter((group) => !group.controller || group.controller === controller()).map(
      (group) => ({
        ...group,
        fields: group.fields.filter(({ name }) => props.without?.includes(name) !== true),
      }),
    ),
  );
  const changed = (): number => changedOf(form, FIELDS);
  return (
    <div class="parameters">
      <header>
        <h2>Tune</h2>
        <p>
          Changes act at once.{' '}
          <Show when={changed() > 0}>
            <strong>{changed()} changed</strong> ·{' '}
          </Show>
          <button
            type="button"
            class="link-like"
            disabled={form.disabled()}
            onClick={() => form.edit(props.scene.defaults)}
          >
            Restore defaults
          </button>
        </p>
      </header>
      <div class="parameter-columns">
        <div>
          <div class="field-columns">
            <For each={PRESET_KINDS}>{(kind) => <Preset form={form} kind={kind} />}</For>
          </div>
          {props.children}
        </div>
        <div>
          <For each={groups()}>{(group) => <GroupBox form={form} group={group} />}</For>
        </div>
      </div>
    </div>
  );
}
