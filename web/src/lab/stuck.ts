// Whether a controller that carries the bead gets nowhere.

import { createMemo, type Accessor } from 'solid-js';
import type { History } from './history';
import type { Trial } from './slices';

/** As long as it has not moved. */
const STILL_S = 3;
/** Of the way that the tool could have gone. */
const LEAST_SHARE = 0.4;

const spread = (places_m: Float64Array): number => Math.max(...places_m) - Math.min(...places_m);

/** Whether the tool was at about one place until a time. */
export function stoodStill(history: History, until_s: number, speed_m_s: number): boolean {
  const { tool_x_m, tool_y_m } = history.window(until_s - STILL_S, until_s);
  const moved_m = Math.hypot(spread(tool_x_m), spread(tool_y_m));
  return tool_x_m.length > 1 && moved_m < LEAST_SHARE * speed_m_s * STILL_S;
}

export function createStuck(lab: Trial): Accessor<boolean> {
  /** Time at which it began to carry. */
  const since_s = createMemo<number | undefined>((before) => {
    const state = lab.state();
    const carries =
      state?.phase.code === 'transporting' && state.controller !== 'you' && !state.hand_m;
    return carries ? Math.min(before ?? Infinity, state.sim_time_s) : undefined;
  });
  return createMemo(() => {
    const [from_s, now_s] = [since_s(), lab.state()?.sim_time_s ?? 0];
    const speed_m_s = lab.scene()?.parameters.transport_speed_m_s;
    if (from_s === undefined || speed_m_s === undefined || now_s - from_s < STILL_S) return false;
    return stoodStill(lab.history, now_s, speed_m_s);
  });
}
