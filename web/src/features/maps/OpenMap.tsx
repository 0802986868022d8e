// Loads a map from a file on the user's computer.

import { For, Show, onCleanup, type JSX } from 'solid-js';
import type { Session } from '../../lab/slices';
import { isOutOfReach, reportWords } from '../../lab/maps';
import { CloseButton } from '../../ui/CloseButton';
import { FileButton } from '../../ui/FileButton';
import { shownName } from '../../ui/name';
import type { MapOpener } from './opener';
import { SmallButton } from '../../ui/SmallButton';
import './maps.css';

export function OpenMap(props: {
  lab: Session;
  opener: MapOpener;
  /** Opens the view Train with the map. */
  onTrain: () => void;
}): JSX.Element {
  const { lab, opener } = props;
  // Another view is opened.
  onCleanup(opener.dismiss);
  const isOff = (): boolean => !lab.canOperate() || opener.isBusy();
  return (
    <>
      <header class="open-map">
        <h3>Map</h3>
        <FileButton
          accept=".svg,image/svg+xml"
          inputName="Drawing of the map"
          disabled={isOff()}
          title="Your own map: an SVG drawing in millimetres, at most 1 MiB"
          onFile={(file) => void opener.open(file)}
        >
          Open SVG…
        </FileButton>
      </header>
      <Show when={opener.added()}>
        {(now) => (
          <div class="map-report" role="status">
            <header>
              <strong>{shownName(now().report.name)}</strong>
              <CloseButton label="Dismiss the report" onClose={opener.dismiss} />
            </header>
            <For each={reportWords(now().report)}>{(words) => <p>{words}</p>}</For>
            <footer>
              <Show when={isOutOfReach(now().report)}>
                <button
                  type="button"
                  class="small primary"
                  title="Adds the drawing again, in the middle of the arm's reach, and smaller if it is too large"
                  disabled={isOff()}
                  onClick={() => void opener.open(now().file, true)}
                >
                  Move into reach
                </button>
              </Show>
              <SmallButton
                title="Opens the view Train: a policy learns this map"
                onClick={() => props.onTrain()}
              >
                Train a policy on it
              </SmallButton>
            </footer>
          </div>
        )}
      </Show>
    </>
  );
}
