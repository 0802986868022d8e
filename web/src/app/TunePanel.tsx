// The parameters, and what the magnet can do with them.

import { Show, type JSX } from 'solid-js';
import { ParameterForm } from '../features/controller/ParameterForm';
import MagnetPanel from '../features/magnet/MagnetPanel';
import type { PanelProps } from '../lab/panel';

export default function TunePanel(props: PanelProps): JSX.Element {
  const { lab } = props;
  return (
    <>
      <h2>Tune</h2>
      <Show when={lab.scene()}>{(scene) => <ParameterForm lab={lab} scene={scene()} />}</Show>
      <MagnetPanel lab={lab} />
    </>
  );
}
