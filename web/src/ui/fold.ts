// Panels that open and close. They stay as the user left them.

import { createSignal, type Accessor } from 'solid-js';
import { recall, remember } from './storage';

export interface Fold {
  readonly isOpen: Accessor<boolean>;
  set(open: boolean): void;
}

/** A panel that is closed until the user opens it. */
export function createFold(name: string): Fold {
  const key = `panel.${name}`;
  const [isOpen, setOpen] = createSignal(recall(key) === 'open');
  return {
    isOpen,
    set(open) {
      setOpen(open);
      remember(key, open ? 'open' : 'closed');
    },
  };
}
