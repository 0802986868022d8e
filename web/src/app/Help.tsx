// A dialog that says what the page shows, with all keys and a switch for single-character shortcuts.

import { CircleQuestionMark, X } from 'lucide';
import { For, createEffect, createSignal, onCleanup, type JSX } from 'solid-js';
import { pageShortcuts } from './pageShortcuts';
import { attachShortcuts, keyName } from '../ui/shortcuts';
import { CONTROLLERS, CONTROLLER_HELP, CONTROLLER_LABELS } from '../lab/parameters';
import { addressOf } from '../net/base';
import { createChoice } from '../ui/storage';
import type { Lab } from '../lab/slices';
import { Glyph } from '../ui/Glyph';
import { Icon } from '../ui/Icon';
import './Help.css';

function WhatYouSee(): JSX.Element {
  return (
    <section class="what-you-see">
      <h3>What you see</h3>
      <p>
        A magnet on a robot arm carries a 5 mm bead to the goal. Sub-controller 1 fetches a lost
        bead. Sub-controller 2 carries it, and sees only the camera picture.
      </p>
      <p>
        Drag the bead to disturb it. Compare shows the three controllers side by side. Lessons
        explain.
      </p>
      <p>There are three sub-controllers 2:</p>
      <ul>
        <For each={CONTROLLERS}>
          {(name) => (
            <li>
              <Glyph of={name} />
              {CONTROLLER_LABELS[name]}: {CONTROLLER_HELP[name]}
            </li>
          )}
        </For>
      </ul>
    </section>
  );
}

const [isOpen, setOpen] = createSignal(false);
const openHelp = (): void => {
  setOpen(true);
};

export function HelpButton(): JSX.Element {
  return (
    <button type="button" title="Help and keyboard shortcuts (?)" onClick={openHelp}>
      <Icon of={CircleQuestionMark} />
      Help
    </button>
  );
}

export function Help(props: { lab: Lab }): JSX.Element {
  let dialog!: HTMLDialogElement;
  const [shortcutsAre, setShortcuts] = createChoice('shortcuts', ['on', 'off']);
  const areOn = (): boolean => shortcutsAre() === 'on';
  const shortcuts = pageShortcuts(
    props.lab,
    () => props.lab.address.view() === 'laboratory',
    openHelp,
  );
  createEffect(() => {
    if (isOpen()) dialog.showModal();
  });
  const groups = [...new Set(shortcuts.map(({ group }) => group))];
  onCleanup(attachShortcuts(shortcuts, areOn));
  return (
    <dialog
      ref={dialog}
      class="keyboard-help"
      onClose={() => setOpen(false)}
      aria-labelledby="help-title"
      onClick={(event) => {
        // A click on the dialog element itself is a click beside its content.
        if (event.target === dialog) dialog.close();
      }}
    >
      <form method="dialog">
        <header>
          <h2 id="help-title">Help</h2>
          <button type="submit" class="ghost icon-only" aria-label="Close" title="Close (Esc)">
            <Icon of={X} />
          </button>
        </header>
        <WhatYouSee />
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
              setShortcuts(event.currentTarget.checked ? 'on' : 'off');
            }}
          />
          These keys work everywhere on the page. The keys of the workspace always work there.
        </label>
        <p>
          Ferry is free software, MIT or Apache-2.0. The page is made with{' '}
          <a href={addressOf('/licenses.txt')}>libraries and a font of others</a>.
        </p>
      </form>
    </dialog>
  );
}
