// A view in the page's frame: its map where the laboratory has its own, a panel beside it, and a dock below both.

import type { JSX } from 'solid-js';
import './ViewFrame.css';

export function ViewFrame(props: {
  class: string;
  /** In the box of the map. */
  map: JSX.Element;
  /** In the bands above and below it. */
  over: JSX.Element;
  under: JSX.Element;
  inspectorName: string;
  inspector: JSX.Element;
  dockName: string;
  dock: JSX.Element;
}): JSX.Element {
  return (
    <>
      <main class={`stage ${props.class}`} data-view>
        <div class="map-box">{props.map}</div>
        <div class="band over">{props.over}</div>
        <div class="band under">{props.under}</div>
      </main>
      <aside class="inspector" data-view aria-label={props.inspectorName}>
        <div class="inspector-panel">{props.inspector}</div>
      </aside>
      <footer class="dock" role="region" data-view aria-label={props.dockName}>
        {props.dock}
      </footer>
    </>
  );
}
