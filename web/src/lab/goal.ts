// The goal as a signal that changes only with the goal.

import { createMemo, type Accessor } from 'solid-js';
import type { StateMessage } from '../net/protocol.gen';
import type { Vec2 } from './geometry';

/** A state arrives every frame; the goal rarely changes. */
export function createGoal(state: Accessor<StateMessage | undefined>): Accessor<Vec2 | undefined> {
  return createMemo<Vec2 | undefined>(
    () => {
      const goal_m = state()?.goal_m;
      return goal_m ? [goal_m[0], goal_m[1]] : undefined;
    },
    undefined,
    { equals: (a, b) => a?.[0] === b?.[0] && a?.[1] === b?.[1] },
  );
}
