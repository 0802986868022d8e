// The inspector: one panel at a time, beside the map. Tabs keep their arrow keys.

import { For, Match, Show, Switch, createMemo, type JSX } from 'solid-js';
import { Dynamic } from 'solid-js/web';
import type { Lab } from '../lab/slices';
import { CloseButton } from '../ui/CloseButton';
import { Segmented } from '../ui/Segmented';
import { isPhone } from '../ui/windowSize';
import { inspectorWidth } from './inspectorWidth';
import { createSheet } from './sheet';
import { EXTRA_PANELS, type PageParts, type Tab, tabOf, TABS } from './panels';
import './Inspector.css';

/** Number of tabs that a key moves by. */
const MOVES: Partial<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

function TabList(props: { lab: Lab; tab: Tab }): JSX.Element {
  const open = (tab: Tab): void => {
    props.lab.showPanel(tab.panels[0].name);
  };
  const onKey = (event: KeyboardEvent): void => {
    const move = MOVES[event.key];
    const next = move && TABS.at((TABS.indexOf(props.tab) + move) % TABS.length);
    if (!next) return;
    event.preventDefault();
    open(next);
    document.getElementById(`tab-${next.title}`)?.focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label="Inspector" onKeyDown={onKey}>
      <For each={TABS}>
        {(tab) => (
          <button
            type="button"
            role="tab"
            id={`tab-${tab.title}`}
            aria-controls="inspector-panel"
            aria-selected={props.tab === tab}
            tabindex={props.tab === tab ? 0 : -1}
            onClick={() => {
              open(tab);
            }}
          >
            {tab.title}
          </button>
        )}
      </For>
    </div>
  );
}

export function Inspector(props: {
  lab: Lab;
  parts: PageParts;
  /** Below every panel, so that the panel does not move when it comes. */
  below: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  let root!: HTMLElement;
  const sheet = createSheet(() => lab.panel() === 'setup', lab.closePanel);
  const panel = createMemo(() => lab.panel());
  const tab = createMemo(() => {
    const name = panel();
    return name === undefined ? undefined : tabOf(name);
  });
  const extra = createMemo(() => EXTRA_PANELS.find(({ name }) => name === panel()));
  const shown = createMemo(() => extra() ?? tab()?.panels.find(({ name }) => name === panel()));
  return (
    <Show when={panel() !== undefined}>
      <aside
        ref={root}
        class="inspector"
        classList={{ tall: isPhone() && sheet.isTall() }}
        aria-label="Inspector"
      >
        <div class="inspector-edge" title="Drag to resize" {...inspectorWidth(() => root)} />
        <Show when={isPhone()}>
          <button type="button" class="sheet-handle" {...sheet.handle}>
            <span class="visually-hidden">Whole height</span>
          </button>
        </Show>
        <Switch>
          <Match when={extra()}>
            {(one) => (
              <header class="inspector-head">
                <h2>{one().title}</h2>
                <CloseButton label="Close" onClose={lab.closePanel} />
              </header>
            )}
          </Match>
          <Match when={tab()}>{(one) => <TabList lab={lab} tab={one()} />}</Match>
        </Switch>
        <div
          id="inspector-panel"
          class="inspector-panel"
          role={extra() ? undefined : 'tabpanel'}
          aria-labelledby={extra() ? undefined : `tab-${tab()?.title ?? ''}`}
        >
          <Show when={(tab()?.panels.length ?? 0) > 1 && tab()}>
            {(one) => (
              <Segmented
                label={one().title}
                name="inspector-part"
                value={shown()?.name ?? one().panels[0].name}
                segments={one().panels.map(({ name, title }) => ({ value: name, label: title }))}
                onChoose={(name) => lab.showPanel(name)}
              />
            )}
          </Show>
          <Show when={shown()} keyed>
            {(one) => <Dynamic component={one.panel} lab={lab} {...props.parts} />}
          </Show>
        </div>
        {props.below}
      </aside>
    </Show>
  );
}
