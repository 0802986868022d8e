// The shape of a controller in its colour, beside its name.

import type { JSX } from 'solid-js';
import { type Controller, LOOKS, SHAPE_PX } from './controllers';
import './Glyph.css';

export function Glyph(props: { of: Controller }): JSX.Element {
  return (
    <svg
      class="glyph"
      viewBox={`0 0 ${SHAPE_PX} ${SHAPE_PX}`}
      style={{ fill: `var(--${LOOKS[props.of].colour})` }}
      aria-hidden="true"
    >
      <path d={LOOKS[props.of].shape} />
    </svg>
  );
}
