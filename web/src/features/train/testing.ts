// A training for the unit tests.

import type { TrainingCells, TrainingFrame, TrainingPoint } from '../../net/protocol.gen';

export function pointOf(update: number, change: Partial<TrainingPoint> = {}): TrainingPoint {
  return {
    update,
    steps: 16 * update,
    episodes: update / 2,
    reward_mean: 0.5,
    reward_deviation: 0.2,
    loss_mean: 0.01,
    ended: 40,
    reached: 30,
    examined: null,
    ...change,
  };
}

/** Three cells in a row, and one above the last. */
export const CELLS: TrainingCells = {
  spacing_m: 0.01,
  goal_m: [0.03, 0.01],
  centers_m: [
    [0.01, 0],
    [0.02, 0],
    [0.03, 0],
    [0.03, 0.01],
  ],
  steps: [3, 2, 1, 0],
};

export function frameOf(update: number, change: Partial<TrainingFrame> = {}): TrainingFrame {
  return {
    update,
    values: [0.7, 0.8, 0.9, 1],
    actions: [0, 0, 2, 3],
    quantiles: CELLS.centers_m.map(() => [0.1, 0.3, 0.2, 0.4, 0.5]),
    endings: ['reached', 'collided', 'timed_out', 'reached'],
    rank_correlation: 1,
    greedy: [{ cells: [0, 1, 2], ending: 'reached' }],
    exploring: [{ cells: [0, 1, 2, 3], ending: 'reached' }],
    ...change,
  };
}
