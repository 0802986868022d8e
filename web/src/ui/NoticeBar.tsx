// A notice at the panel whose control caused it. A hint disappears after some time; an error stays until it is read.

import { Show, createEffect, on, onCleanup, type JSX } from 'solid-js';
import { CloseButton } from './CloseButton';
import './NoticeBar.css';

const SHOWN_MS = 7000;

export interface Notice {
  readonly id: number;
  /** A refusal, or a hint of this page. */
  readonly tone: 'error' | 'hint';
  readonly text: string;
}

export function NoticeBar(props: {
  notice: Notice | undefined;
  /** Name of the panel, for tests. */
  place: string;
  onDismiss: (id: number) => void;
}): JSX.Element {
  const dismiss = (): void => {
    if (props.notice) props.onDismiss(props.notice.id);
  };
  createEffect(
    on(
      () => props.notice,
      (now) => {
        if (now?.tone !== 'hint') return;
        const timer = setTimeout(dismiss, SHOWN_MS);
        onCleanup(() => {
          clearTimeout(timer);
        });
      },
    ),
  );
  // The region is always in the document: screen readers announce what appears inside it.
  return (
    <div class="notices" role="alert" data-place={props.place}>
      <Show when={props.notice}>
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
