// Panels that open and close. They stay as the user left them.

import { createChoice } from './storage';

export type Fold = ReturnType<typeof createFold>;

/** A panel that is closed until the user opens it. */
export function createFold(name: string) {
  const [state, setState] = createChoice(`panel.${name}`, ['closed', 'open']);
  return {
    isOpen: (): boolean => state() === 'open',
    set: (open: boolean) => setState(open ? 'open' : 'closed'),
  };
}
