// A controller's name with its shape.

import type { JSX } from 'solid-js';
import { isController } from '../../ui/controllers';
import { Glyph } from '../../ui/Glyph';

/** Programs have names of their own. */
export function Mark(props: { of: string }): JSX.Element {
  return <Glyph of={isController(props.of) ? props.of : 'program'} />;
}

export function Named(props: { of: string; children: JSX.Element }): JSX.Element {
  return (
    <span class="named">
      <Mark of={props.of} />
      {props.children}
    </span>
  );
}
