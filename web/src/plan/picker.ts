// Picks a place for a form: the next click on the workspace, or Enter at its cursor.

import { createSignal, type Accessor } from 'solid-js';
import type { Vec2 } from '../lab/geometry';

type Take = (at: Vec2) => void;

export interface Picker {
  readonly isPicking: Accessor<boolean>;
  /** Passes the next chosen place to `take`. */
  start(take: Take): void;
  /** Whether `take` waits for the next place. */
  isFor(take: Take): boolean;
  /** Offers a place. Returns false if the picker does not wait for one; then the place is a goal. */
  offer(at: Vec2): boolean;
  cancel: () => void;
}

export function createPicker(): Picker {
  const [taker, setTaker] = createSignal<{ take: Take }>();
  return {
    isPicking: () => taker() !== undefined,
    start(take) {
      setTaker({ take });
    },
    isFor: (take) => taker()?.take === take,
    offer(at) {
      const waiting = taker();
      setTaker(undefined);
      waiting?.take(at);
      return waiting !== undefined;
    },
    cancel() {
      setTaker(undefined);
    },
  };
}
