// Evaluations for the unit tests.

import type {
  EvaluationCell,
  EvaluationReport,
  EvaluationSummary,
  Row,
} from '../../net/protocol.gen';

export function cellOf(change: Partial<EvaluationCell> = {}): EvaluationCell {
  return {
    controller: 'rl',
    map: 'posts',
    disturbances: 0,
    program: null,
    varied: [],
    done: 0,
    delivered: 0,
    elapsed_s: 0,
    paper: null,
    ...change,
  };
}

export function summaryOf(change: Partial<EvaluationSummary> = {}): EvaluationSummary {
  return {
    id: 'evaluation-3',
    query: {
      controllers: ['rl'],
      maps: ['posts'],
      disturbances: [0],
      episodes: 10,
      seed: 1,
      rl_policy: 'auto',
      program: null,
      vary: [],
    },
    stage: 'running',
    message: null,
    cells: [cellOf()],
    rows_done: 0,
    ...change,
  };
}

export const ROW: Row = {
  controller: 'errt',
  map: 'posts',
  disturbances: 3,
  varied: [],
  episodes: 30,
  successes: 29,
  successes_wilson95: [0.833, 0.994],
  delivered: 28,
  wilson95: [0.787, 0.982],
  tracking_error_mean_m: 0.0141,
  tracking_error_mean95_m: [0.0132, 0.015],
  tracking_error_mean_x_m: 0.009,
  tracking_error_mean_y_m: 0.0085,
  tracking_error_max_x_m: 0.05,
  tracking_error_max_y_m: 0.0649,
  path_ratio_mean: 1.043,
  steps_mean: 62.5,
  switches_mean: 6.1,
  disturbances_struck: 88,
  changes: [],
  trained_on_map: null,
  beyond_steps: 0,
  by_hand: false,
  tool_apart: false,
  decision_ms_p50: 2.26,
  decision_ms_p99: 7.5,
};

export function reportOf(change: Partial<EvaluationReport> = {}): EvaluationReport {
  return {
    ...summaryOf({ stage: 'done', rows_done: 1 }),
    rows: [ROW],
    comparisons: [],
    failures: [],
    ...change,
  };
}
