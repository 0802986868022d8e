// The layers, behind a button: more of them than fit beside the title.

import { For, Show, createEffect, createSignal, onCleanup, type JSX } from 'solid-js';
import { LAYER_GROUPS, type Layer } from './layers';

export function LayerMenu(props: {
  layers: ReadonlySet<Layer>;
  onLayer: (layer: Layer, on: boolean) => void;
  /** Why a layer cannot be shown, if it cannot. */
  reason: (layer: Layer) => string | undefined;
}): JSX.Element {
  let menu!: HTMLDivElement;
  let button!: HTMLButtonElement;
  const [open, setOpen] = createSignal(false);
  const close = (): void => {
    setOpen(false);
  };

  createEffect(() => {
    if (!open()) return;
    const onDown = (event: PointerEvent): void => {
      if (menu.contains(event.target as Node)) return;
      close();
      // A click that is to close the menu is to place no goal. Buttons hear of the click all the same.
      event.stopPropagation();
    };
    const onKey = (event: KeyboardEvent): void => {
      if (event.key !== 'Escape') return;
      // What has the focus is about to go.
      if (menu.contains(document.activeElement)) button.focus();
      close();
    };
    document.addEventListener('pointerdown', onDown, true);
    document.addEventListener('keydown', onKey);
    onCleanup(() => {
      document.removeEventListener('pointerdown', onDown, true);
      document.removeEventListener('keydown', onKey);
    });
  });

  return (
    <div
      ref={menu}
      class="layer-menu"
      onFocusOut={({ relatedTarget }) => {
        // The keyboard went on; a click beside the boxes focuses nothing.
        if (relatedTarget && !menu.contains(relatedTarget as Node)) close();
      }}
    >
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
