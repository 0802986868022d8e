// Loads a map from a file on the user's computer.

import { For, Show, createSignal, type JSX } from 'solid-js';
import { loadMap } from '../../lab/loadMap';
import { onFileDrop } from '../../ui/fileDrop';
import { addMap, isOutOfReach, reportWords } from './maps';
import type { MapReport } from '../../net/protocol.gen';
import type { Notices, Session, Trial } from '../../lab/slices';
import './maps.css';

interface Added {
  readonly file: File;
  readonly report: MapReport;
}

export function OpenMap(props: { lab: Session & Trial & Notices }): JSX.Element {
  const { lab } = props;
  let input!: HTMLInputElement;
  const [busy, setBusy] = createSignal(false);
  /** What the server says about the new map, until it is dismissed or another map is chosen. */
  const [added, setAdded] = createSignal<Added>();
  const shown = (): Added | undefined => {
    const now = added();
    // A map that is out of reach may not have been loaded.
    const stays = now && (isOutOfReach(now.report) || now.report.name === lab.scene()?.map);
    return stays ? now : undefined;
  };
  const send = async (file: File, fit = false): Promise<void> => {
    setBusy(true);
    try {
      const report = await addMap(file, fit);
      setAdded({ file, report });
      loadMap(lab, report.name);
    } catch (reason) {
      lab.notify('playback', reason instanceof Error ? reason.message : String(reason));
    }
    setBusy(false);
  };
  onFileDrop(/\.svg$/i, (file) => {
    if (lab.canOperate() && !busy()) void send(file);
  });
  return (
    <div class="open-map">
      <button
        type="button"
        disabled={!lab.canOperate() || busy()}
        // On a small screen only the first word is visible.
        aria-label="Open map…"
        title="Your own map: an SVG drawing in millimetres, at most 1 MiB"
        onClick={() => {
          input.click();
        }}
      >
        Open<span class="spelt-out"> map</span>…
      </button>
      <input
        ref={input}
        type="file"
        accept=".svg,image/svg+xml"
        aria-label="Drawing of the map"
        hidden
        onChange={() => {
          const file = input.files?.[0];
          if (file) void send(file);
          // The same file may be chosen again after it was corrected.
          input.value = '';
        }}
      />
      <Show when={shown()}>
        {(now) => (
          <div class="map-report" role="status">
            <header>
              <strong>{now().report.name}</strong>
              <button
                type="button"
                class="bare"
                aria-label="Dismiss the report"
                onClick={() => setAdded(undefined)}
              >
                ×
              </button>
            </header>
            <For each={reportWords(now().report)}>{(words) => <p>{words}</p>}</For>
            <Show when={isOutOfReach(now().report)}>
              <button
                type="button"
                class="small primary"
                title="Adds the drawing again, in the middle of the arm's reach, and smaller if it is too large"
                disabled={!lab.canOperate() || busy()}
                onClick={() => void send(now().file, true)}
              >
                Move into reach
              </button>
            </Show>
          </div>
        )}
      </Show>
    </div>
  );
}
