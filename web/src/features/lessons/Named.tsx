// Words of a lesson, with the names of buttons, layers and panels marked as names.

import { For, type JSX } from 'solid-js';

/** Names are between asterisks. */
export function Named(props: { words: string }): JSX.Element {
  return (
    <For each={props.words.split('*')}>
      {(part, index) => (index() % 2 === 1 ? <b>{part}</b> : part)}
    </For>
  );
}
