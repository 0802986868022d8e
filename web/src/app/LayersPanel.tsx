// Which layers the map shows.

import { For, type JSX } from 'solid-js';
import { hiddenBecause, LAYER_GROUPS } from '../plan/layer';
import type { PanelProps } from '../lab/panel';
import { MAP_LAYERS } from './layers';
import { LayerSwatch } from './LayerSwatch';
import './LayersPanel.css';

/** Topmost layer first. */
const MENU = MAP_LAYERS.toReversed();

export function LayersPanel(props: PanelProps): JSX.Element {
  return (
    <div class="layers" role="group" aria-label="Layers">
      <For each={LAYER_GROUPS}>
        {(group) => (
          <fieldset>
            <legend>{group}</legend>
            <For each={MENU.filter((layer) => layer.group === group)}>
              {(layer) => {
                const { id, label } = layer;
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
                    <LayerSwatch layer={layer} />
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
