import type { History } from '../../lab/history';
import type { StateMessage } from '../../net/protocol.gen';

export interface Trail {
  readonly of: 'tool' | 'bead';
  /** Oldest first. */
  readonly xs_m: Float64Array;
  readonly ys_m: Float64Array;
}

const NONE = new Float64Array();

/** The trails from the start of the trial up to a state. */
export function trailsOf(state: StateMessage, history: History): readonly [Trail, Trail] {
  const [toolX = NONE, toolY = NONE, beadX = NONE, beadY = NONE] = history.window(
    0,
    state.sim_time_s,
    ['tool_x_m', 'tool_y_m', 'bead_x_m', 'bead_y_m'],
  );
  return [
    { of: 'tool', xs_m: toolX, ys_m: toolY },
    { of: 'bead', xs_m: beadX, ys_m: beadY },
  ];
}
