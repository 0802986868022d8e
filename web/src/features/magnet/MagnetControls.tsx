// Height and friction beside the curves.

import { For, Show, type JSX } from 'solid-js';
import { FIELDS } from '../../lab/parameters';
import type { Parameters, SceneMessage } from '../../net/protocol.gen';
import { createForm, FieldRow } from '../../lab/ParameterField';
import type { Session, Trial } from '../../lab/slices';

/** The parameters that are beside the curves, and not among the others. */
export const BESIDE_CURVES: readonly (keyof Parameters)[] = ['tool_height_m', 'friction'];

const SHOWN = FIELDS.filter(({ name }) => BESIDE_CURVES.includes(name));

function Controls(props: { lab: Session & Trial; scene: SceneMessage }): JSX.Element {
  const form = createForm(props.lab, () => props.scene);
  return (
    <div class="field-columns" role="group" aria-label="Magnet and friction">
      <For each={SHOWN}>{(field) => <FieldRow form={form} field={field} />}</For>
    </div>
  );
}

export function MagnetControls(props: { lab: Session & Trial }): JSX.Element {
  return (
    <Show when={props.lab.scene()}>{(scene) => <Controls lab={props.lab} scene={scene()} />}</Show>
  );
}
