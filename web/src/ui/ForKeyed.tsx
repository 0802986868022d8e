// A list whose items are replaced by newer ones of the same key. What is drawn of an item stays, with the focus in it.

import { For, Show, createMemo, type Accessor, type JSX } from 'solid-js';

export function ForKeyed<T extends object>(props: {
  each: readonly T[] | undefined;
  by: (item: T) => string;
  children: (item: Accessor<T>) => JSX.Element;
}): JSX.Element {
  const byKey = createMemo(() => new Map((props.each ?? []).map((item) => [props.by(item), item])));
  return (
    <For each={[...byKey().keys()]}>
      {(key) => <Show when={byKey().get(key)}>{(item) => props.children(item)}</Show>}
    </For>
  );
}
