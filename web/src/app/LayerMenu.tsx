// The layers, behind a button: more of them than fit beside the title.

import { For, Show, type JSX } from 'solid-js';
import { createPopover } from '../ui/popover';
import { type Layer, LAYER_GROUPS } from '../lab/layers';

export function LayerMenu(props: {
  layers: ReadonlySet<Layer>;
  onLayer: (layer: Layer, on: boolean) => void;
  /** Why a layer cannot be shown, if it cannot. */
  reason: (layer: Layer) => string | undefined;
}): JSX.Element {
  let menu!: HTMLDivElement;
  let button!: HTMLButtonElement;
  const { open, setOpen, onFocusOut } = createPopover(
    () => menu,
    () => button,
  );

  return (
    <div ref={menu} class="layer-menu" onFocusOut={onFocusOut}>
      <button
        ref={button}
        type="button"
        class="small"
        aria-expanded={open()}
        aria-controls="layers"
        onClick={() => {
          setOpen(!open());
        }}
      >
        Layers
      </button>
      <Show when={open()}>
        <div id="layers" class="layers" role="group" aria-label="Layers">
          <For each={LAYER_GROUPS}>
            {(group) => (
              <fieldset>
                <legend>{group.title}</legend>
                <For each={group.layers}>
                  {([id, label]) => (
                    <label title={props.reason(id)}>
                      <input
                        type="checkbox"
                        checked={props.layers.has(id) && !props.reason(id)}
                        disabled={props.reason(id) !== undefined}
                        onChange={(event) => {
                          props.onLayer(id, event.currentTarget.checked);
                        }}
                      />
                      {label}
                    </label>
                  )}
                </For>
              </fieldset>
            )}
          </For>
        </div>
      </Show>
    </div>
  );
}
