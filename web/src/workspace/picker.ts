// The next click on the plan, or Enter at its cursor, for somebody who asked for a place.

import { createSignal, type Accessor } from 'solid-js';
import type { Vec2 } from '../transform';

export interface Picker {
  readonly isPicking: Accessor<boolean>;
  /** Gives the next chosen place to `take`. */
  begin(take: (at: Vec2) => void): void;
  /** Whether somebody asked for the place; else it is a goal. */
  offer(at: Vec2): boolean;
  cancel: () => void;
}

export function createPicker(): Picker {
  const [taker, setTaker] = createSignal<{ take: (at: Vec2) => void }>();
  return {
    isPicking: () => taker() !== undefined,
    begin(take) {
      setTaker({ take });
    },
    offer(at) {
      const asked = taker();
      setTaker(undefined);
      asked?.take(at);
      return asked !== undefined;
    },
    cancel() {
      setTaker(undefined);
    },
  };
}
