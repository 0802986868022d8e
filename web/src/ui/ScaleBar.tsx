// How long 5 cm are on the map.

import type { JSX } from 'solid-js';
import './ScaleBar.css';

/** The size of most maps, and of the box that maps fill. */
const [WIDTH_M, HEIGHT_M] = [0.58, 0.33];

export function ScaleBar(props: {
  /** Of the map in the box, if that may differ. */
  width_m?: number | undefined;
  height_m?: number | undefined;
}): JSX.Element {
  const shown_m = (): number =>
    Math.max(props.width_m ?? WIDTH_M, ((props.height_m ?? HEIGHT_M) * WIDTH_M) / HEIGHT_M);
  return (
    <span class="scale-bar">
      <span aria-hidden="true" style={{ width: `calc(var(--map-width) * ${0.05 / shown_m()})` }} />5
      cm
    </span>
  );
}
