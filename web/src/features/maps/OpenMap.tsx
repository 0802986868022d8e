// Loads a map from a file on the user's computer.

import { createSignal, type JSX } from 'solid-js';
import { loadMap } from '../../lab/loadMap';
import { addMap } from './maps';
import type { Notices, Session, Trial } from '../../lab/slices';
import './maps.css';

export function OpenMap(props: { lab: Session & Trial & Notices }): JSX.Element {
  const { lab } = props;
  let input!: HTMLInputElement;
  const [busy, setBusy] = createSignal(false);
  const send = async (file: File): Promise<void> => {
    setBusy(true);
    try {
      loadMap(lab, await addMap(file));
    } catch (reason) {
      lab.notify('playback', reason instanceof Error ? reason.message : String(reason));
    }
    setBusy(false);
  };
  return (
    <>
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
    </>
  );
}
