// How long 5 cm are on the map.

import type { JSX } from 'solid-js';
import './ScaleBar.css';

export function ScaleBar(): JSX.Element {
  return (
    <span class="scale-bar">
      <span aria-hidden="true" />5 cm
    </span>
  );
}
