// The parameters, and what the magnet can do with them.

import { Show, type JSX } from 'solid-js';
import { ParameterForm } from '../features/controller/ParameterForm';
import { BESIDE_CURVES } from '../features/magnet/MagnetControls';
import { MagnetPanel } from '../features/magnet/MagnetPanel';
import type { PanelProps } from '../lab/panel';

export default function TunePanel(props: PanelProps): JSX.Element {
  const { lab } = props;
  return (
    <Show when={lab.scene()}>
      {(scene) => (
        <ParameterForm lab={lab} scene={scene()} without={BESIDE_CURVES}>
          <MagnetPanel lab={lab} />
        </ParameterForm>
      )}
    </Show>
  );
}
