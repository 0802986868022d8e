// What a trial is made of: map, preset, seed.

import { Show, type JSX } from 'solid-js';
import type { PageExperiment } from '../lab/pageExperiment';
import type { PanelProps } from '../lab/panel';
import { MapChoice } from '../features/maps/MapChoice';
import { OpenMap } from '../features/maps/OpenMap';
import type { MapOpener } from '../features/maps/opener';
import { PresetSelect } from '../features/share/PresetSelect';
import { Seed } from '../features/setup/Seed';
import './SetUpPanel.css';

export default function SetUpPanel(
  props: PanelProps & {
    links: PageExperiment;
    opener: MapOpener;
    /** Opens the view Train with the map of the trial. */
    onTrain: () => void;
  },
): JSX.Element {
  const { lab } = props;
  return (
    <Show when={lab.scene()}>
      {(scene) => (
        <>
          <OpenMap lab={lab} opener={props.opener} onTrain={props.onTrain} />
          <MapChoice lab={lab} map={scene().map} />
          <footer class="inspector-foot setup">
            <PresetSelect lab={lab} links={props.links} />
            <Seed lab={lab} seed={scene().seed} />
          </footer>
        </>
      )}
    </Show>
  );
}
