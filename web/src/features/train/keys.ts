// The plan of a training by keyboard.

import type { Shortcut } from '../../ui/shortcuts';

/** Shown in the help. The plan handles these keys itself. */
export const TRAIN_SHORTCUTS: readonly Shortcut[] = [
  {
    group: 'Train',
    keys: ['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown'],
    does: 'choose the next cell of the plan',
  },
];
