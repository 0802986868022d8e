// Sets up a failed trial again in the live session. Pure.

import type { Cell, ClientMessage, EvaluationFailure, Parameters } from '../../net/protocol.gen';

/** Evaluations use these parameters, and what is varied. */
export function setUpAgain(
  cell: Cell,
  failure: EvaluationFailure,
  parameters: Parameters,
): ClientMessage {
  return {
    type: 'load_scenario',
    map: cell.map,
    controller: cell.controller,
    disturbances: cell.disturbances,
    seed: failure.seed,
    parameters: {
      ...parameters,
      ...Object.fromEntries(cell.varied.map(({ name, value }) => [name, value])),
    },
    ...(failure.start_m && { start_m: failure.start_m }),
    ...(failure.goal_m && { goal_m: failure.goal_m }),
  };
}
