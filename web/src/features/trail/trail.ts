import type { History } from '../../lab/history';
import type { StateMessage } from '../../net/protocol.gen';

export interface Trail {
  readonly of: 'tool' | 'bead';
  /** Oldest first. */
  readonly xs_m: Float64Array;
  readonly ys_m: Float64Array;
}

/** The trails from the start of the trial up to a state. */
export function trailsOf(state: StateMessage, history: History): readonly [Trail, Trail] {
  const { tool_x_m, tool_y_m, bead_x_m, bead_y_m } = history.window(0, state.sim_time_s);
  return [
    { of: 'tool', xs_m: tool_x_m, ys_m: tool_y_m },
    { of: 'bead', xs_m: bead_x_m, ys_m: bead_y_m },
  ];
}
