// Why the value of a field is refused.

import { Show, type JSX } from 'solid-js';

export function Fault(props: { id: string; text: string | undefined }): JSX.Element {
  return (
    <div id={props.id} role="alert">
      <Show when={props.text}>{(text) => <p class="refusal">{text()}</p>}</Show>
    </div>
  );
}
