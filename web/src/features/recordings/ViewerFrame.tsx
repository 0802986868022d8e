// Rerun's viewer with one recording, in a frame. Only the frame's page may compile WebAssembly; this page may not.

import { Show, createEffect, on, type JSX } from 'solid-js';
import type { RecordingFile } from '../../net/protocol.gen';
import { label } from './recordings';
import { SmallButton } from '../../ui/SmallButton';
import { type ThemeMessage, viewerAddress } from './viewerMessages';
import { theme, type Theme } from '../../ui/theme';

const LEAVE_KEY = 'F6';

export function ViewerFrame(props: {
  file: RecordingFile;
  name: string;
  onAgain: () => void;
  onClose: () => void;
}): JSX.Element {
  let frame!: HTMLIFrameElement;
  let closer!: HTMLButtonElement;
  // The address holds the first theme. Later themes are sent as messages, because a new address would reload the viewer.
  const address = viewerAddress(props.file.id, theme());
  const sendTheme = (theme: Theme): void => {
    const message: ThemeMessage = { type: 'theme', theme };
    frame.contentWindow?.postMessage(message, location.origin);
  };
  createEffect(on(theme, sendTheme, { defer: true }));
  // The viewer uses the Tab key itself, so keyboard users need another key to leave it.
  const listenForLeaving = (): void => {
    const leave = (event: KeyboardEvent): void => {
      if (event.key !== LEAVE_KEY) return;
      event.preventDefault();
      closer.focus();
    };
    frame.contentWindow?.addEventListener('keydown', leave, { capture: true });
  };
  return (
    <section class="viewer" aria-labelledby="viewer-title">
      <header>
        <h2 id="viewer-title">
          {props.name} <span class="rule">{label(props.file)}</span>
        </h2>
        <Show when={props.file.live}>
          <span class="rule">still recording; this shows the data at the time of opening</span>
          <SmallButton onClick={props.onAgain}>Reload</SmallButton>
        </Show>
        <span class="rule">
          <kbd>{LEAVE_KEY}</kbd> leaves the viewer
        </span>
        <SmallButton ref={closer} onClick={props.onClose}>
          Close
        </SmallButton>
      </header>
      <iframe ref={frame} src={address} title="Rerun viewer" onLoad={listenForLeaving} />
    </section>
  );
}
