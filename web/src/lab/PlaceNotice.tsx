// The notice at a panel whose control caused it. A hint disappears after some time; an error stays until it is read.

import { Show, createEffect, createMemo, onCleanup, type JSX } from 'solid-js';
import { CloseButton } from '../ui/CloseButton';
import type { Place } from './places';
import type { Notices } from './slices';
import './PlaceNotice.css';

const SHOWN_MS = 7000;

export function PlaceNotice(props: { lab: Notices; place: Place }): JSX.Element {
  const notice = createMemo(() => props.lab.notices()[props.place]);
  const dismiss = (): void => {
    const now = notice();
    if (now) props.lab.dismiss(props.place, now.id);
  };
  createEffect(() => {
    if (notice()?.tone !== 'hint') return;
    const timer = setTimeout(dismiss, SHOWN_MS);
    onCleanup(() => {
      clearTimeout(timer);
    });
  });
  // The region is always in the document: screen readers announce what appears inside it.
  return (
    <div
      class="notices"
      role="alert"
      // Browser tests find it by this name.
      data-place={props.place === 'playback' ? 'transport' : props.place}
    >
      <Show when={notice()}>
        {(now) => (
          <p class="notice" data-tone={now().tone}>
            <span>{now().text}</span>
            <CloseButton label="Dismiss" onClose={dismiss} />
          </p>
        )}
      </Show>
    </div>
  );
}
