// A dialog with all keys of the page, and a switch for single-character shortcuts.

import { For, createSignal, onCleanup, type JSX } from 'solid-js';
import { pageShortcuts } from './pageShortcuts';
import { attachShortcuts, keyName } from '../ui/shortcuts';
import { recall, remember } from '../ui/storage';
import type { View } from './views';
import type { Lab } from '../lab/slices';
import './KeyboardHelp.css';

const KEY = 'shortcuts';

export function KeyboardHelp(props: { lab: Lab; view: View }): JSX.Element {
  let dialog!: HTMLDialogElement;
  const [areOn, setOn] = createSignal(recall(KEY) !== 'off');
  const open = (): void => {
    if (!dialog.open) dialog.showModal();
  };
  const shortcuts = pageShortcuts(props.lab, () => props.view === 'laboratory', open);
  const groups = [...new Set(shortcuts.map(({ group }) => group))];
  onCleanup(attachShortcuts(shortcuts, areOn));
  const choose = (on: boolean): void => {
    setOn(on);
    remember(KEY, on ? 'on' : 'off');
  };
  return (
    <>
      <button
        type="button"
        class="small"
        aria-label="Keyboard shortcuts"
        title="Keyboard shortcuts (?)"
        onClick={open}
      >
        ?
      </button>
      <dialog
        ref={dialog}
        class="keyboard-help"
        aria-labelledby="keyboard-title"
        onClick={(event) => {
          // A click on the dialog element itself is a click beside its content.
          if (event.target === dialog) dialog.close();
        }}
      >
        <form method="dialog">
          <header>
            <h2 id="keyboard-title">Keyboard</h2>
            <button type="submit" class="small">
              Close
            </button>
          </header>
          <div class="key-groups">
            <For each={groups}>
              {(group) => (
                <section>
                  <h3>{group}</h3>
                  <dl>
                    <For each={shortcuts.filter((shortcut) => shortcut.group === group)}>
                      {(shortcut) => (
                        <div>
                          <dt>
                            <For each={shortcut.keys}>{(key) => <kbd>{keyName(key)}</kbd>}</For>
                          </dt>
                          <dd>{shortcut.does}</dd>
                        </div>
                      )}
                    </For>
                  </dl>
                </section>
              )}
            </For>
          </div>
          <label class="key-switch">
            <input
              type="checkbox"
              checked={areOn()}
              onChange={(event) => {
                choose(event.currentTarget.checked);
              }}
            />
            These keys work everywhere on the page. The keys of the workspace always work there.
          </label>
        </form>
      </dialog>
    </>
  );
}
