// How a line of a plot looks, beside its name.

import type { JSX } from 'solid-js';
import { type CurveLine, dashesOf } from './curve';
import './LineKey.css';

export function LineKey(props: { of: Pick<CurveLine, 'color' | 'isDashed'> }): JSX.Element {
  return (
    <svg
      class="line-key"
      viewBox="0 0 18 4"
      preserveAspectRatio="xMinYMid slice"
      aria-hidden="true"
    >
      <path
        d="M1 2h16"
        style={{ stroke: `var(--${props.of.color})` }}
        stroke-dasharray={dashesOf(props.of, 2).join(' ')}
      />
    </svg>
  );
}
