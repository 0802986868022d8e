// Magnet, height and friction beside the curves: the same parameters as in the form.

import { For, Show, type JSX } from 'solid-js';
import { FIELDS } from '../../lab/parameters';
import type { Parameters, SceneMessage } from '../../net/protocol.gen';
import { createForm, FieldRow } from '../../lab/ParameterField';
import type { Session, Trial } from '../../lab/slices';

/** Short names that differ from those in the form. */
const LABELS: readonly (readonly [name: keyof Parameters, label: string])[] = [
  ['block_orientation', 'Magnet'],
  ['tool_height_m', 'Height'],
  ['friction', 'Friction'],
];

const SHOWN = LABELS.flatMap(([name, label]) =>
  FIELDS.filter((field) => field.name === name).map((field) => ({ ...field, label })),
);

function Controls(props: { lab: Session & Trial; scene: SceneMessage }): JSX.Element {
  const form = createForm(props.lab, () => props.scene);
  return (
    <div class="magnet-controls" role="group" aria-label="Magnet and friction">
      <For each={SHOWN}>{(field) => <FieldRow form={form} field={field} />}</For>
    </div>
  );
}

export function MagnetControls(props: { lab: Session & Trial }): JSX.Element {
  return (
    <Show when={props.lab.scene()}>{(scene) => <Controls lab={props.lab} scene={scene()} />}</Show>
  );
}
