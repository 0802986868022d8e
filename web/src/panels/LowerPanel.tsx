// Below the workspace: the plots against time, or what the magnet can do.

import { For, createSignal, type JSX } from 'solid-js';
import { Dynamic } from 'solid-js/web';
import type { Lab } from '../lab';
import type { Theme } from '../theme';
import { MagnetPanel } from './MagnetPanel';
import { PlotsPanel } from './PlotsPanel';

const TABS = [
  { id: 'plots', title: 'Plots', panel: PlotsPanel },
  { id: 'magnet', title: 'Magnet', panel: MagnetPanel },
] as const;

/** How far a key moves along the tabs. */
const MOVES: Partial<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

export function LowerPanel(props: { lab: Lab; theme: () => Theme }): JSX.Element {
  const [index, setIndex] = createSignal(0);
  const tab = () => TABS[index()] ?? TABS[0];
  const buttons: HTMLButtonElement[] = [];
  const onKey = (event: KeyboardEvent): void => {
    const move = MOVES[event.key];
    if (move === undefined) return;
    event.preventDefault();
    const next = (index() + move + TABS.length) % TABS.length;
    setIndex(next);
    buttons[next]?.focus();
  };
  return (
    <section class="panel lower">
      <div class="tabs" role="tablist" aria-label="Below the workspace" onKeyDown={onKey}>
        <For each={TABS}>
          {({ id, title }, at) => (
            <button
              ref={(button) => (buttons[at()] = button)}
              type="button"
              role="tab"
              id={`tab-${id}`}
              aria-controls="lower-panel"
              aria-selected={index() === at()}
              tabindex={index() === at() ? 0 : -1}
              onClick={() => {
                setIndex(at());
              }}
            >
              {title}
            </button>
          )}
        </For>
      </div>
      <div
        id="lower-panel"
        class="lower-content"
        role="tabpanel"
        aria-labelledby={`tab-${tab().id}`}
      >
        <Dynamic component={tab().panel} lab={props.lab} theme={props.theme} />
      </div>
    </section>
  );
}
