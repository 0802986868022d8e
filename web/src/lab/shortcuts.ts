// The keys that a feature adds to the page.

import type { Shortcut } from '../ui/shortcuts';
import type { Lab } from './slices';

/** `operate` wraps actions of the operator. They run only while the laboratory is visible and has a state. */
export type FeatureShortcuts<L = Lab> = (
  lab: L,
  operate: (act: () => void) => () => void,
) => readonly Shortcut[];
