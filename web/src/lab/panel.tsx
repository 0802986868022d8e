// A panel under a tab.

import type { Component } from 'solid-js';
import { lazyPart, type Load } from '../ui/lazyPart';
import type { TabHead } from '../ui/Tabs';
import type { Lab } from './slices';

export interface PanelProps<L = Lab> {
  readonly lab: L;
  /** The panel's own controls beside the tabs. */
  readonly tools: HTMLElement;
}

/** What a feature exports for a tab; `app` lists them. */
export interface TabPanel extends TabHead {
  readonly panel: Component<PanelProps>;
}

/** A tab whose code is loaded when it is opened for the first time. */
export const lazyTab = (title: string, load: Load<PanelProps>): TabPanel => ({
  id: title.toLowerCase(),
  title,
  panel: lazyPart(load, 'tab', (missing) => missing ?? <p class="placeholder">Loading…</p>),
});
