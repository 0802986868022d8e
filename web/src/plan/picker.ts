// The next click on the plan, or Enter at its cursor, for somebody who asked for a place.

import { createSignal, type Accessor } from 'solid-js';
import type { Vec2 } from '../lab/geometry';

type Take = (at: Vec2) => void;

export interface Picker {
  readonly isPicking: Accessor<boolean>;
  /** Gives the next chosen place to `take`. */
  begin(take: Take): void;
  /** Whether the next place goes to `take`. */
  asks(take: Take): boolean;
  /** Whether somebody asked for the place; else it is a goal. */
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
