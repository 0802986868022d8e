// The menu of layers, opened by a button.

import { For, Show, type JSX } from 'solid-js';
import { createPopover } from '../ui/popover';
import { hiddenBecause, LAYER_GROUPS, type MapLayer } from '../plan/layer';
import type { Lab } from '../lab/slices';
import './LayerMenu.css';

/** Stripes of equal width. */
function stripes(names: MapLayer['swatch']): string {
  const end = (index: number): string => `${((100 * index) / names.length).toFixed(1)}%`;
  const stops = names.map((name, index) => `var(--${name}) ${end(index)} ${end(index + 1)}`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

export function LayerMenu(props: {
  lab: Lab;
  /** In menu order within each group. */
  layers: readonly MapLayer[];
}): JSX.Element {
  const popover = createPopover('layers');

  return (
    <div {...popover.box} class="layer-menu">
      <button {...popover.button} class="small">
        Layers
      </button>
      <Show when={popover.open()}>
        <div id="layers" class="layers" role="group" aria-label="Layers">
          <For each={LAYER_GROUPS}>
            {(group) => (
              <fieldset>
                <legend>{group}</legend>
                <For each={props.layers.filter((layer) => layer.group === group)}>
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
      </Show>
    </div>
  );
}
