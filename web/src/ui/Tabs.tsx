// Panels under tabs, with arrow keys to move between the tabs.

import { For, Show, createEffect, createMemo, untrack, type JSX } from 'solid-js';
import { createFold } from './fold';
import { FoldButton } from './FoldButton';
import { createChoice } from './storage';
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
  let root!: HTMLElement;
  const tools = document.createElement('div');
  tools.className = 'tab-tools';
  const [first, ...rest] = props.tabs;
  const [open, setOpen] = createChoice(`tab.${props.area}`, [
    first.id,
    ...rest.map(({ id }) => id),
  ]);
  const tab = createMemo(() => props.tabs.find(({ id }) => id === open()) ?? first);
  const fold = createFold(props.area);
  const panel = createMemo(() => {
    const now = tab();
    return fold.isOpen() ? untrack(() => props.children(now, tools)) : undefined;
  });
  createEffect(() => {
    const found = props.tabs.find(({ id }) => id === props.opened);
    if (!found) return;
    setOpen(found.id);
    fold.set(true);
    props.onOpened();
    // On a phone it is below the workspace.
    requestAnimationFrame(() => {
      root.scrollIntoView({ block: 'start' });
    });
  });
  const onKey = (event: KeyboardEvent): void => {
    const move = MOVES[event.key];
    if (move === undefined) return;
    event.preventDefault();
    const at = props.tabs.indexOf(tab());
    const next = props.tabs[(at + move + props.tabs.length) % props.tabs.length] ?? first;
    setOpen(next.id);
    document.getElementById(`tab-${next.id}`)?.focus();
  };
  return (
    <section ref={root} class={`panel ${props.area}`} data-closed={fold.isOpen() ? undefined : ''}>
      <div class="tab-strip">
        <FoldButton fold={fold} controls={`${props.area}-panel`} label={props.label} />
        <div class="tabs" role="tablist" aria-label={props.label} onKeyDown={onKey}>
          <For each={props.tabs}>
            {({ id, title }) => (
              <button
                type="button"
                role="tab"
                id={`tab-${id}`}
                aria-controls={`${props.area}-panel`}
                aria-selected={open() === id}
                tabindex={open() === id ? 0 : -1}
                onClick={() => {
                  setOpen(id);
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
