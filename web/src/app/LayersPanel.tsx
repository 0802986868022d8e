// Which layers the map shows.

import { For, type JSX } from 'solid-js';
import { hiddenBecause, LAYER_GROUPS, type MapLayer } from '../plan/layer';
import type { PanelProps } from '../lab/panel';
import { MAP_LAYERS } from './layers';
import './LayersPanel.css';

/** Topmost layer first. */
const MENU = MAP_LAYERS.toReversed();

/** Stripes of equal width. */
function stripes(names: MapLayer['swatch']): string {
  const end = (index: number): string => `${((100 * index) / names.length).toFixed(1)}%`;
  const stops = names.map((name, index) => `var(--${name}) ${end(index)} ${end(index + 1)}`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

export function LayersPanel(props: PanelProps): JSX.Element {
  return (
    <div class="layers" role="group" aria-label="Layers">
      <For each={LAYER_GROUPS}>
        {(group) => (
          <fieldset>
            <legend>{group}</legend>
            <For each={MENU.filter((layer) => layer.group === group)}>
              {(layer) => {
                const { id, label, swatch } = layer;
                const reason = (): string | undefined => hiddenBecause(layer, props.lab);
                return (
                  <label title={reason()}>
                    <input
                      type="checkbox"
                      checked={props.lab.layers().has(id) && !reason()}
                      disabled={reason() !== undefined}
                      onChange={(event) => {
                        props.lab.showLayer(id, event.currentTarget.checked);
                      }}
                    />
                    <span
                      class="swatch"
                      aria-hidden="true"
                      style={{ background: stripes(swatch) }}
                    />
                    {label}
                  </label>
                );
              }}
            </For>
          </fieldset>
        )}
      </For>
    </div>
  );
}
