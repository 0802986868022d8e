// The stretches of a trial: who carried the bead when, and when the arm fetched it. Pure.

import { MARKS } from '../../lab/model';
import type { ControllerName, EventMessage, StateMessage } from '../../net/protocol.gen';

export interface Stretch {
  readonly from_tick: number;
  /** Undefined where the events do not tell it. */
  readonly controller: ControllerName | undefined;
  readonly isFetching: boolean;
}

/**
 * In order of time; each one ends where the next one begins. `first` is the controller of the start, `state` is the
 * newest one. A session keeps its events, so the page needs not have been open at their time.
 */
export function stretches(
  events: readonly EventMessage[],
  first: ControllerName,
  state: Pick<StateMessage, 'mode' | 'controller'>,
): readonly Stretch[] {
  const takeovers = events.flatMap(({ what }) => (what.code === 'took_over' ? [what] : []));
  // Each takeover changes the sub-controller.
  const mode = takeovers[0] ? 3 - takeovers[0].sub_controller : state.mode;
  // Of too many events, the page does not have the oldest ones.
  const controller = events.length < MARKS ? first : undefined;
  const found: Stretch[] = [{ from_tick: 0, controller, isFetching: mode === 1 }];
  const change = (from_tick: number, to: Partial<Omit<Stretch, 'from_tick'>>): void => {
    const last = found.at(-1);
    if (!last) return;
    if (last.from_tick === from_tick) found.pop();
    found.push({ ...last, ...to, from_tick });
  };
  for (const { tick, what } of events) {
    if (what.code === 'controller_selected') change(tick, { controller: what.controller });
    else if (what.code === 'took_over') change(tick, { isFetching: what.sub_controller === 1 });
  }
  // A robot client takes the arm without an event.
  if (found.at(-1)?.controller !== state.controller) {
    change(found.at(-1)?.from_tick ?? 0, { controller: state.controller });
  }
  return found;
}
