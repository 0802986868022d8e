// An icon of lucide. It has no name of its own: the control that it stands in has one.

import { For, type JSX } from 'solid-js';
import { Dynamic } from 'solid-js/web';
import type { IconNode } from 'lucide';

export function Icon(props: { of: IconNode; class?: string }): JSX.Element {
  return (
    <svg class={`icon ${props.class ?? ''}`} viewBox="0 0 24 24" aria-hidden="true">
      <For each={props.of}>
        {([tag, attributes]) => <Dynamic component={tag} {...attributes} />}
      </For>
    </svg>
  );
}
