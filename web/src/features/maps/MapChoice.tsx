// The maps of the server as pictures. A press starts a trial on one.

import { For, type JSX } from 'solid-js';
import { loadTrial } from '../../lab/loadTrial';
import { MapPicture } from '../../lab/MapPicture';
import type { Session, Trial } from '../../lab/slices';
import { shownName } from '../../ui/name';
import { createPending } from '../../ui/pending';
import './maps.css';

export function MapChoice(props: { lab: Session & Trial; map: string }): JSX.Element {
  const { lab } = props;
  const choice = createPending(
    () => props.map,
    (map) => loadTrial(lab, 'playback', { map }),
  );
  return (
    <fieldset class="map-choice" role="radiogroup" aria-label="Map">
      <For each={lab.catalog.maps()}>
        {(map) => (
          <label>
            <input
              type="radio"
              name="map"
              value={map}
              checked={choice.value() === map}
              disabled={!lab.canOperate()}
              aria-busy={choice.isPending() && choice.value() === map}
              onChange={() => {
                choice.choose(map);
              }}
            />
            <MapPicture map={map} />
            <span class="map-name">{shownName(map)}</span>
          </label>
        )}
      </For>
    </fieldset>
  );
}
