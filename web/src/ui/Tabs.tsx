// Panels that share a place: tabs to choose one, arrow keys to go along them.

import { For, createEffect, createSignal, type Component, type JSX } from 'solid-js';
import { Dynamic } from 'solid-js/web';
import type { Lab } from '../lab/lab';
import { recall, remember } from './storage';
import type { Theme } from './theme';

export interface PanelProps {
  readonly lab: Lab;
  readonly theme: () => Theme;
}

export interface TabProps extends PanelProps {
  /** Room for a panel's own controls, beside the tabs. */
  readonly tools: HTMLElement;
}

export interface Tab {
  readonly id: string;
  readonly title: string;
  readonly panel: Component<TabProps>;
}

/** How far a key moves along the tabs. */
const MOVES: Partial<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

export function Tabs(
  props: PanelProps & {
    area: string;
    label: string;
    tabs: readonly [Tab, ...Tab[]];
    /** What stands beside the tabs whichever is chosen. */
    aside?: JSX.Element;
  },
): JSX.Element {
  const tools = document.createElement('div');
  tools.className = 'tab-tools';
  // A look at another view, or a reload, is no reason to lose one's place.
  const key = `tab.${props.area}`;
  const kept = props.tabs.findIndex(({ id }) => id === recall(key));
  const [index, setIndex] = createSignal(Math.max(0, kept));
  createEffect(() => {
    remember(key, tab().id);
  });
  const tab = () => props.tabs[index()] ?? props.tabs[0];
  const buttons: HTMLButtonElement[] = [];
  createEffect(() => {
    const asked = props.lab.opened()?.tab;
    const found = props.tabs.findIndex(({ id }) => id === asked);
    if (found < 0) return;
    setIndex(found);
    props.lab.openTab(undefined);
  });
  const onKey = (event: KeyboardEvent): void => {
    const move = MOVES[event.key];
    if (move === undefined) return;
    event.preventDefault();
    const next = (index() + move + props.tabs.length) % props.tabs.length;
    setIndex(next);
    buttons[next]?.focus();
  };
  return (
    <section class={`panel ${props.area}`}>
      <div class="tab-strip">
        <div class="tabs" role="tablist" aria-label={props.label} onKeyDown={onKey}>
          <For each={props.tabs}>
            {({ id, title }, at) => (
              <button
                ref={(button) => (buttons[at()] = button)}
                type="button"
                role="tab"
                id={`tab-${id}`}
                aria-controls={`${props.area}-panel`}
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
        {tools}
        {props.aside}
      </div>
      <div
        id={`${props.area}-panel`}
        class="tab-content"
        role="tabpanel"
        aria-labelledby={`tab-${tab().id}`}
      >
        <Dynamic component={tab().panel} lab={props.lab} theme={props.theme} tools={tools} />
      </div>
    </section>
  );
}
