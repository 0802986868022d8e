// The legend of a picture, below it.

import { Show, type JSX } from 'solid-js';
import './legend.css';

export function MapLegend(props: {
  name: string;
  class?: string;
  /** Why something is missing. */
  error: string | undefined;
  children: JSX.Element;
  /** In a line of its own. */
  below?: JSX.Element;
}): JSX.Element {
  return (
    <div class={`map-legend ${props.class ?? ''}`} role="group" aria-label={props.name}>
      {props.children}
      <span role="alert">
        <Show when={props.error}>{(text) => <span class="refusal">{text()}</span>}</Show>
      </span>
      {props.below}
    </div>
  );
}

/** The colours between a smallest and a greatest value. */
export function Ramp(props: {
  of: 'value' | 'heat' | 'field';
  least: string;
  greatest: string;
}): JSX.Element {
  return (
    <>
      <span class="number" data-testid={`${props.of}-least`}>
        {props.least}
      </span>
      <span class={`heat-ramp of-${props.of}`} aria-hidden="true" />
      <span class="number" data-testid={`${props.of}-greatest`}>
        {props.greatest}
      </span>
    </>
  );
}
