// How many goals were delivered, and how long the last one took. The server counts each arrival, also that after a disturbance at a goal that was reached.

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

/** How long the delivery of the present goal took, in simulated time. */
export function deliveryTime_s(
  state: Pick<StateMessage, 'tick' | 'phase'> | undefined,
  marks: readonly EventMessage[],
): number | undefined {
  if (state?.phase.code !== 'delivered') return undefined;
  const past = marks.filter(({ tick }) => tick <= state.tick);
  const goal = past.findLastIndex(({ what }) => what.code === 'goal_placed');
  const delivered = past.slice(goal + 1).find(({ what }) => what.code === 'delivered');
  return delivered && delivered.sim_time_s - (past[goal]?.sim_time_s ?? 0);
}
