// What a trial is made of: map, preset, seed.

import { Show, createMemo, type JSX } from 'solid-js';
import { loadTrial } from '../../lab/loadTrial';
import type { PageExperiment } from '../../lab/pageExperiment';
import type { PanelProps } from '../../lab/panel';
import { ServerSelect } from '../../ui/ServerSelect';
import { OpenMap } from '../maps/OpenMap';
import type { MapOpener } from '../maps/opener';
import { PresetSelect } from '../share/PresetSelect';
import { Seed } from './Seed';
import './setup.css';

export function SetUpPanel(
  props: PanelProps & {
    links: PageExperiment;
    opener: MapOpener;
    /** Opens the view Train with the map of the trial. */
    onTrain: () => void;
  },
): JSX.Element {
  const { lab } = props;
  const maps = createMemo(() => (lab.catalog.maps() ?? []).map((name) => [name, name] as const));
  return (
    <Show when={lab.scene()}>
      {(scene) => (
        <div class="setup">
          <ServerSelect
            label="Map"
            value={scene().map}
            options={maps()}
            disabled={!lab.canOperate()}
            onChoose={(map) => loadTrial(lab, 'playback', { map })}
          />
          <OpenMap lab={lab} opener={props.opener} onTrain={props.onTrain} />
          <PresetSelect lab={lab} links={props.links} />
          <Seed lab={lab} seed={scene().seed} />
        </div>
      )}
    </Show>
  );
}
