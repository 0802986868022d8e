// Opens a session of the visitor's own. A refusal is shown beside the button.

import { Show, createSignal, type JSX } from 'solid-js';
import { reasonText } from '../net/problem';
import { capital } from '../ui/format';
import { openOwn } from './ownSession';

export function OwnSessionButton(props: {
  class: string;
  /** What follows the path of the session's page. */
  rest?: string;
  children: JSX.Element;
}): JSX.Element {
  const [isBusy, setBusy] = createSignal(false);
  const [refused, setRefused] = createSignal<string>();
  const open = async (): Promise<void> => {
    setBusy(true);
    try {
      await openOwn(props.rest);
    } catch (reason) {
      setRefused(reasonText(reason));
      setBusy(false);
    }
  };
  return (
    <>
      <button
        type="button"
        class={props.class}
        disabled={isBusy()}
        aria-busy={isBusy()}
        onClick={() => void open()}
      >
        {props.children}
      </button>
      <Show when={refused()}>
        <span class="refusal" role="alert">
          {capital(refused() ?? '')}
        </span>
      </Show>
    </>
  );
}
