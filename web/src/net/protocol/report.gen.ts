// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { EvaluationCell, EvaluationQuery, Setting } from './evaluations.gen';
import type { JobStage } from './jobs.gen';

/**
 * One row of the table.
 */
export type Row = { 
/**
 * Sub-controller 2.
 */
controller: string, map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, 
/**
 * What varied parameters are in this row.
 */
varied: Array<Setting>, episodes: number, 
/**
 * Trials whose tool reached the goal (paper's test).
 */
successes: number, 
/**
 * Wilson 95 % interval of `successes / episodes`.
 */
successes_wilson95: [number, number], 
/**
 * Trials whose bead reached the goal.
 */
delivered: number, 
/**
 * Wilson 95 % interval of `delivered / episodes`.
 */
wilson95: [number, number], 
/**
 * Mean over trials of the mean distance of tool and bead during transport.
 */
tracking_error_mean_m: number, 
/**
 * Its 95 % interval (Student's t); missing for fewer than two trials.
 */
tracking_error_mean95_m: [number, number] | null, 
/**
 * Mean over trials of the mean absolute difference in x during transport.
 */
tracking_error_mean_x_m: number, 
/**
 * The same in y.
 */
tracking_error_mean_y_m: number, 
/**
 * Mean over trials of the maximum difference in x during transport.
 */
tracking_error_max_x_m: number, 
/**
 * The same in y.
 */
tracking_error_max_y_m: number, 
/**
 * Mean over delivered trials of the tool's path divided by the shortest path; missing without a delivery.
 */
path_ratio_mean: number | null, 
/**
 * Mean control steps.
 */
steps_mean: number, switches_mean: number, 
/**
 * Disturbances applied in all trials together.
 */
disturbances_struck: number, 
/**
 * Parameters that differ from the default, each as `NAME=VALUE`: shield, visit penalty, camera and all others.
 */
changes: Array<string>, 
/**
 * Whether the policy was trained on this map; `null` for controllers without a policy.
 */
trained_on_map: boolean | null, 
/**
 * Trials whose goal no transport of `step_limit` steps can reach.
 */
beyond_steps: number, 
/**
 * Whether a hand draws the bead away through free space; otherwise it is lifted.
 */
by_hand: boolean, 
/**
 * Whether the tool starts at least 15 cm from the bead; otherwise above it.
 */
tool_apart: boolean, 
/**
 * Median duration of a control step in milliseconds, including the camera.
 */
decision_ms_p50: number, decision_ms_p99: number, };

/**
 * A mean difference.
 */
export type PairedMean = { mean: number, 
/**
 * Its 95 % interval (Student's t).
 */
interval95: [number, number], 
/**
 * The interval at the level that is corrected for the number of comparisons in the report (Bonferroni).
 */
interval_corrected: [number, number], };

/**
 * Two controllers compared trial by trial, with the same starts, goals, seeds and disturbances.
 */
export type Comparison = { map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, 
/**
 * What varied parameters are in both rows.
 */
varied: Array<Setting>, 
/**
 * Controller that is compared.
 */
controller: string, 
/**
 * Controller that it is compared with.
 */
against: string, episodes: number, 
/**
 * Trials delivered by both.
 */
both: number, 
/**
 * Trials delivered by the first only.
 */
first_only: number, 
/**
 * Trials delivered by the second only.
 */
second_only: number, 
/**
 * Trials delivered by neither.
 */
neither: number, 
/**
 * Share delivered by the first minus that by the second.
 */
delivered_difference: number, 
/**
 * Its 95 % interval (Newcombe 1998, method 10).
 */
delivered_difference95: [number, number], 
/**
 * The interval at the level that is corrected for the number of comparisons in the report (Bonferroni).
 */
delivered_difference_corrected: [number, number], 
/**
 * Control steps of the first minus those of the second, where both delivered.
 */
steps: PairedMean | null, 
/**
 * The same for the mean distance of tool and bead during transport.
 */
tracking_error_mean_m: PairedMean | null, 
/**
 * The same for path ÷ shortest path.
 */
path_ratio: PairedMean | null, 
/**
 * Control steps over all trials. One that was not delivered counts with all steps that its legs may take.
 */
steps_of_all: PairedMean | null, 
/**
 * Path ÷ shortest path over all trials. One that was not delivered counts with the path of all these steps.
 */
path_ratio_of_all: PairedMean | null, };

/**
 * A trial that did not deliver. Its seed, start and goal, with map, controller and disturbances of its cell, set it
 * up again.
 */
export type EvaluationFailure = { 
/**
 * Its cell, from 0.
 */
cell: number, 
/**
 * Index of the trial.
 */
index: number, 
/**
 * Seed of the trial itself, as text.
 */
seed: string, 
/**
 * Bead and tool at the start.
 */
start_m: [number, number] | null, goal_m: [number, number] | null, 
/**
 * Whether the tool came to the goal.
 */
reached: boolean, 
/**
 * How it ended.
 */
outcome: string, 
/**
 * What kept sub-controller 2 from the goal, if anything.
 */
trouble: string | null, 
/**
 * Why the arm held at the end, if it did.
 */
refusal: string | null, 
/**
 * Control steps.
 */
steps: number, 
/**
 * Disturbances applied.
 */
disturbances: number, };

/**
 * Answer of `GET /api/evaluations/{id}`.
 */
export type EvaluationReport = { 
/**
 * Rows of the complete cells, in their order, as in `ferry evaluate --json`.
 */
rows: Array<Row>, 
/**
 * Every pair of controllers on the same map with the same disturbances.
 */
comparisons: Array<Comparison>, 
/**
 * Trials that did not deliver.
 */
failures: Array<EvaluationFailure>, id: string, query: EvaluationQuery, stage: JobStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * Its cells, in the order in which they run.
 */
cells: Array<EvaluationCell>, 
/**
 * Number of complete cells.
 */
rows_done: number, };
