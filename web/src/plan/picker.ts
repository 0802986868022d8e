// Picks a place for a form: the next click on the workspace, or Enter at its cursor.

import { createSignal, type Accessor } from 'solid-js';
import type { Vec2 } from '../lab/geometry';

type Take = (at: Vec2) => void;

export interface Picker {
  readonly isPicking: Accessor<boolean>;
  /** Passes the next chosen place to `take`. */
  begin(take: Take): void;
  /** Whether `take` waits for the next place. */
  asks(take: Take): boolean;
  /** Offers a place. Returns false if the picker does not wait for one; then the place is a goal. */
  offer(at: Vec2): boolean;
  cancel: () => void;
}

export function createPicker(): Picker {
  const [taker, setTaker] = createSignal<{ take: Take }>();
  return {
    isPicking: () => taker() !== undefined,
    begin(take) {
      setTaker({ take });
    },
    asks: (take) => taker()?.take === take,
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
