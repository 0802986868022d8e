// Opens and closes a panel.

import type { JSX } from 'solid-js';
import type { Fold } from './fold';
import './FoldButton.css';

export function FoldButton(props: {
  fold: Fold;
  /** Id of the content. */
  controls: string;
  /** The name, if there are no children. */
  label?: string;
  children?: JSX.Element;
}): JSX.Element {
  return (
    <button
      type="button"
      class="bare fold"
      aria-expanded={props.fold.isOpen()}
      aria-controls={props.controls}
      aria-label={props.label}
      title={props.fold.isOpen() ? 'Close' : 'Open'}
      onClick={() => {
        props.fold.set(!props.fold.isOpen());
      }}
    >
      {props.children}
    </button>
  );
}
