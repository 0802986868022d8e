// A map from a file of this computer.

import { createSignal, type JSX } from 'solid-js';
import { loadMap } from '../../lab/loadMap';
import { addMap } from './maps';
import type { Notices, Session, Trial } from '../../lab/slices';

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
        // On a laptop one sees but its first word.
        aria-label="Open map…"
        title="A map of your own: a drawing as SVG, in millimetres, of 1 MiB at most"
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
          // The same file may be chosen again, when it was mended.
          input.value = '';
        }}
      />
    </>
  );
}
