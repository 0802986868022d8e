// The form of the parameters. Each edit sends all parameters; the form shows the server's values.

import { For, Index, Show, createMemo, type JSX } from 'solid-js';
import { GROUPS, PRESET_KINDS, presetOf, type Group, type PresetKind } from '../../lab/parameters';
import type { SceneMessage } from '../../net/protocol.gen';
import { createForm, FieldRow, type Form } from '../../lab/ParameterField';
import type { Session, Trial } from '../../lab/slices';
import { createFold } from '../../ui/fold';
import { ChoiceField } from '../../ui/fields/fields';
import { FoldButton } from '../../ui/FoldButton';
import { SmallButton } from '../../ui/SmallButton';
import './ParameterForm.css';

const changedOf = (form: Form, group: Group): number =>
  group.fields.filter(({ name }) => form.values()[name] !== form.defaults()[name]).length;

function GroupBox(props: { form: Form; group: Group }): JSX.Element {
  const { form, group } = props;
  const changed = (): number => changedOf(form, group);
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

function Presets(props: { form: Form; kind: PresetKind }): JSX.Element {
  const { form, kind } = props;
  const { presets } = kind;
  const index = (): number => presetOf(kind, form.values());
  return (
    <div class="presets">
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
    </div>
  );
}

export function ParameterForm(props: { lab: Session & Trial; scene: SceneMessage }): JSX.Element {
  const { lab } = props;
  const form = createForm(lab, () => props.scene);
  const controller = createMemo(() => lab.state()?.controller);
  // Parameters of other controllers have no effect now.
  const groups = createMemo(() =>
    GROUPS.filter((group) => !group.controller || group.controller === controller()),
  );
  const changed = (): number => groups().reduce((sum, group) => sum + changedOf(form, group), 0);
  const fold = createFold('parameters');
  return (
    <div class="parameters">
      <div class="parameters-head">
        <h3>
          <FoldButton fold={fold} controls="parameter-groups">
            Parameters
          </FoldButton>
          <Show when={!fold.isOpen() && changed() > 0}>
            <span class="changed-count">{changed()} changed</span>
          </Show>
        </h3>
        <Show when={fold.isOpen()}>
          <SmallButton disabled={form.disabled()} onClick={() => form.edit(props.scene.defaults)}>
            Restore defaults
          </SmallButton>
        </Show>
      </div>
      <div id="parameter-groups" hidden={!fold.isOpen()}>
        <Show when={fold.isOpen()}>
          <For each={PRESET_KINDS}>{(kind) => <Presets form={form} kind={kind} />}</For>
          <For each={groups()}>{(group) => <GroupBox form={form} group={group} />}</For>
        </Show>
      </div>
    </div>
  );
}
