// A panel of the inspector whose code is loaded when it is opened for the first time.

import type { Component } from 'solid-js';
import { lazyPart, type Load } from '../ui/lazyPart';
import type { Lab } from './slices';

/** What a feature exports as a panel; `app` lists them. */
export interface PanelProps<L = Lab> {
  readonly lab: L;
}

export const lazyPanel = <P extends object>(load: Load<P>): Component<P> =>
  lazyPart(load, 'panel', (missing) => missing ?? <p class="placeholder">Loading…</p>);
