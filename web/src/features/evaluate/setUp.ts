// A trial that failed, set up again in the live session. Pure.

import type { Cell, ClientMessage, EvaluationFailure, Parameters } from '../../net/protocol.gen';

/** Evaluations run with the parameters' defaults. */
export function setUpAgain(
  cell: Cell,
  failure: EvaluationFailure,
  defaults: Parameters,
): ClientMessage {
  return {
    type: 'load_scenario',
    map: cell.map,
    controller: cell.controller,
    disturbances: cell.disturbances,
    seed: failure.seed,
    parameters: defaults,
    ...(failure.start_m && { start_m: failure.start_m }),
    ...(failure.goal_m && { goal_m: failure.goal_m }),
  };
}
