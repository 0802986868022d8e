// How many goals were delivered. The server counts each arrival, also that after a disturbance at a goal that was reached.

import type { EventMessage, StateMessage } from '../net/protocol.gen';

export function deliveredGoals(
  state: Pick<StateMessage, 'tick' | 'deliveries'> | undefined,
  marks: readonly EventMessage[],
): number | undefined {
  if (!state) return undefined;
  let again = 0;
  let isDelivered = false;
  for (const { what, tick: at } of marks) {
    if (at > state.tick) break;
    if (what.code === 'goal_placed' || what.code === 'goal_removed') isDelivered = false;
    else if (what.code === 'delivered') {
      if (isDelivered) again += 1;
      isDelivered = true;
    }
  }
  return Math.max(0, state.deliveries - again);
}
