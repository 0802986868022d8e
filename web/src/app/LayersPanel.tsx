// Which layers the map shows, and the key to them and to the marks.

import { For, Show, type JSX } from 'solid-js';
import { hiddenBecause, LAYER_GROUPS, type LiveLayer } from '../plan/layer';
import type { PanelProps } from '../lab/panel';
import { MarksKey } from '../features/marks/MarksKey';
import { LayerSwatch } from './LayerSwatch';
import './LayersPanel.css';

export default function LayersPanel(
  props: PanelProps & { layers: readonly LiveLayer[] },
): JSX.Element {
  // Topmost layer first.
  const menu = props.layers.toReversed();
  return (
    <>
      <div class="layers" role="group" aria-label="Layers">
        <For each={LAYER_GROUPS}>
          {(group) => (
            <fieldset>
              <legend>{group}</legend>
              <For each={menu.filter((layer) => layer.group === group)}>
                {(layer) => {
                  const { id, label } = layer;
                  const reason = (): string | undefined => hiddenBecause(layer, props.lab);
                  return (
                    <>
                      <label title={reason()}>
                        <input
                          type="checkbox"
                          checked={layer.isShown()}
                          disabled={reason() !== undefined}
                          onChange={(event) => {
                            props.lab.showLayer(id, event.currentTarget.checked);
                          }}
                        />
                        <LayerSwatch layer={layer} />
                        {label}
                      </label>
                      <Show when={layer.isShown()}>{layer.legend?.()}</Show>
                    </>
                  );
                }}
              </For>
            </fieldset>
          )}
        </For>
      </div>
      <MarksKey />
    </>
  );
}
