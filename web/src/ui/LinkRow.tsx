// A link to copy.

import { createEffect, createSignal, type JSX } from 'solid-js';
import { Copy } from 'lucide';
import { Icon } from './Icon';
import './LinkRow.css';

export function LinkRow(props: {
  title: string;
  address: string;
  children: JSX.Element;
}): JSX.Element {
  let field!: HTMLInputElement;
  const [copied, setCopied] = createSignal('');
  createEffect(() => {
    // It has changed since it was copied.
    if (props.address) setCopied('');
  });
  const select = (): void => {
    field.focus();
    field.select();
    setCopied('Selected: copy it with the keyboard or the menu.');
  };
  const copy = (): void => {
    // The clipboard is missing on a page loaded by plain HTTP from another machine.
    const clipboard = navigator.clipboard as Clipboard | undefined;
    if (clipboard) clipboard.writeText(field.value).then(() => setCopied('Copied.'), select);
    else select();
  };
  return (
    <section class="link-row" aria-label={props.title}>
      <h3>{props.title}</h3>
      <div class="link-field">
        <input
          ref={field}
          type="text"
          readonly
          aria-label={`Link: ${props.title}`}
          value={props.address}
          onFocus={() => field.select()}
        />
        <button type="button" aria-label={`Copy: ${props.title}`} onClick={copy}>
          <Icon of={Copy} />
          Copy
        </button>
      </div>
      <p class="hint">{props.children}</p>
      <p class="link-done" role="status">
        {copied()}
      </p>
    </section>
  );
}
