// Panels under tabs, with arrow keys to move between the tabs.

import { For, Show, createEffect, createMemo, createSignal, untrack, type JSX } from 'solid-js';
import { createFold } from './fold';
import { FoldButton } from './FoldButton';
import { recall, remember } from './storage';
import './Tabs.css';

/** Number of tabs that a key moves by. */
const MOVES: Partial<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

export interface TabHead {
  readonly id: string;
  readonly title: string;
}

export function Tabs<T extends TabHead>(props: {
  /** Class of the section and part of the storage key of the open tab. */
  area: string;
  label: string;
  tabs: readonly [T, ...T[]];
  /** A tab to open, in any tab area. */
  opened: string | undefined;
  onOpened: () => void;
  /** Controls beside the tabs, for all tabs. */
  aside?: JSX.Element;
  /** The panel of a tab. `tools` is the element for the panel's own controls beside the tabs. */
  children: (tab: T, tools: HTMLElement) => JSX.Element;
}): JSX.Element {
  const tools = document.createElement('div');
  tools.className = 'tab-tools';
  const key = `tab.${props.area}`;
  const kept = props.tabs.findIndex(({ id }) => id === recall(key));
  const [index, setIndex] = createSignal(Math.max(0, kept));
  const tab = createMemo(() => props.tabs[index()] ?? props.tabs[0]);
  createEffect(() => {
    remember(key, tab().id);
  });
  const fold = createFold(props.area);
  const panel = createMemo(() => {
    const now = tab();
    return fold.isOpen() ? untrack(() => props.children(now, tools)) : undefined;
  });
  const buttons: HTMLButtonElement[] = [];
  createEffect(() => {
    const found = props.tabs.findIndex(({ id }) => id === props.opened);
    if (found < 0) return;
    setIndex(found);
    fold.set(true);
    props.onOpened();
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
    <section class={`panel ${props.area}`} data-closed={fold.isOpen() ? undefined : ''}>
      <div class="tab-strip">
        <FoldButton fold={fold} controls={`${props.area}-panel`} label={props.label} />
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
                  fold.set(true);
                }}
              >
                {title}
              </button>
            )}
          </For>
        </div>
        <Show when={fold.isOpen()}>
          {tools}
          {props.aside}
        </Show>
      </div>
      <div
        id={`${props.area}-panel`}
        class="tab-content"
        role="tabpanel"
        aria-labelledby={`tab-${tab().id}`}
        hidden={!fold.isOpen()}
      >
        {panel()}
      </div>
    </section>
  );
}
