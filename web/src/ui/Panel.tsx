// A panel with its name at its head.

import type { JSX } from 'solid-js';

export function Panel(props: {
  name: string;
  class?: string;
  ref?: (panel: HTMLElement) => void;
  /** Beside the name. */
  head?: JSX.Element;
  children: JSX.Element;
}): JSX.Element {
  return (
    <section ref={props.ref} class={`panel ${props.class ?? ''}`} aria-label={props.name}>
      <header class="panel-head">
        <h2>{props.name}</h2>
        {props.head}
      </header>
      {props.children}
    </section>
  );
}
