// Loads a map from a file on the user's computer.

import { For, Show, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { isOutOfReach, reportWords } from '../../lab/maps';
import { CloseButton } from '../../ui/CloseButton';
import { FileButton } from '../../ui/FileButton';
import { shownName } from '../../ui/name';
import type { MapOpener } from './opener';
import { TrialLines } from './TrialLines';
import { SmallButton } from '../../ui/SmallButton';
import './maps.css';

export function OpenMap(props: {
  lab: Session & Trial;
  opener: MapOpener;
  /** Opens the view Train with the map. */
  onTrain: () => void;
}): JSX.Element {
  const { lab, opener } = props;
  const trials = () => opener.trials()?.all() ?? [];
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
            <TrialLines lab={lab} trials={trials()} />
            <Show when={trials().length > 0}>
              <p class="hint">
                Trials with random starts and goals, in the background. Evaluate lists them.
              </p>
            </Show>
            <footer>
              <Show when={isOutOfReach(now().report)}>
                <button
                  type="button"
                  class="small primary"
                  title="Adds the drawing again, in the middle of the arm's reach, and smaller if it is too large"
                  disabled={isOff()}
                  onClick={() => void opener.open(now().file, { fit: true })}
                >
                  Move into reach
                </button>
              </Show>
              <SmallButton
                classList={{ small: true, primary: opener.trials()?.isUnsolved() === true }}
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
