// What was refused, at the panel whose control caused it.

import { Show, createEffect, on, onCleanup, type JSX } from 'solid-js';
import type { Lab } from '../lab/lab';
import type { Place } from '../lab/model';

const SHOWN_MS = 7000;

export function NoticeBar(props: { lab: Lab; place: Place }): JSX.Element {
  const { lab } = props;
  const notice = () => lab.notices()[props.place];
  const dismiss = (): void => {
    const now = notice();
    if (now) lab.dismiss(props.place, now.id);
  };
  createEffect(
    on(notice, (now) => {
      if (!now) return;
      const timer = setTimeout(dismiss, SHOWN_MS);
      onCleanup(() => {
        clearTimeout(timer);
      });
    }),
  );
  // The region is always there: screen readers announce what appears inside of it.
  return (
    <div class="notices" role="alert" data-place={props.place}>
      <Show when={notice()}>
        {(now) => (
          <p class="notice" data-tone={now().tone}>
            <span>{now().text}</span>
            <button type="button" class="bare" aria-label="Dismiss" onClick={dismiss}>
              ×
            </button>
          </p>
        )}
      </Show>
    </div>
  );
}
