// A named number in a list.

import type { JSX } from 'solid-js';
import './Fact.css';

export function Fact(props: {
  name: string;
  value: string;
  help?: string;
  testid?: string;
  alarm?: boolean;
}): JSX.Element {
  return (
    <div>
      <dt title={props.help}>{props.name}</dt>
      <dd class="number" classList={{ alarm: props.alarm ?? false }} data-testid={props.testid}>
        {props.value}
      </dd>
    </div>
  );
}
