// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { ControllerName } from './experiment.gen';
import type { JobStage } from './jobs.gen';

/**
 * A parameter with evenly spaced values, ends included.
 */
export type Variation = { 
/**
 * Name of a parameter that is a number.
 */
name: string, 
/**
 * First value, in the unit of the name.
 */
from: number, 
/**
 * Last value.
 */
to: number, 
/**
 * Number of values, 2 to 20.
 */
count: number, };

/**
 * Body of `POST /api/evaluations`: every controller on every map with every number of disturbances, each on the
 * same starts, goals and seeds.
 */
export type EvaluationQuery = { 
/**
 * Sub-controllers 2.
 */
controllers: Array<ControllerName>, 
/**
 * Names of maps, shipped or added.
 */
maps: Array<string>, 
/**
 * Scripted disturbances per trial, 0 to 10.
 */
disturbances: Array<number>, 
/**
 * Trials per cell, 1 to 1000.
 */
episodes: number, 
/**
 * Seed of the trials.
 */
seed: number, 
/**
 * Policy of the controller `rl`, as the parameter `rl_policy`.
 */
rl_policy: string, 
/**
 * Name of a connected program, with the controller `program`.
 */
program: string | null, 
/**
 * Parameters that take several values, at most two. Each combination has its cells.
 */
vary: Array<Variation>, };

/**
 * The subject of one row of the table.
 */
export type Cell = { 
/**
 * Sub-controller 2.
 */
controller: ControllerName, map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, 
/**
 * Name of the program, with the controller `program`.
 */
program: string | null, 
/**
 * What varied parameters are in this cell.
 */
varied: Array<Setting>, };

/**
 * The paper's numbers for a row.
 */
export type PaperRow = { 
/**
 * Source in the paper.
 */
section: string, episodes: number, 
/**
 * Trials whose tool reached the goal.
 */
successes: number, 
/**
 * Wilson 95 % interval of `successes / episodes`.
 */
successes_wilson95: [number, number], printed: string, 
/**
 * Mean tracking error in both axes.
 */
tracking_error_mean_m: number | null, 
/**
 * Mean over trials of the largest in x.
 */
tracking_error_max_x_m: number | null, 
/**
 * The same in y.
 */
tracking_error_max_y_m: number | null, };

/**
 * A varied parameter's value in one row.
 */
export type Setting = { name: string, value: number, };

/**
 * A cell of an evaluation with its progress.
 */
export type EvaluationCell = { 
/**
 * Number of trials that ended.
 */
done: number, 
/**
 * Number of these that delivered.
 */
delivered: number, 
/**
 * Time until the last trial ended.
 */
elapsed_s: number, 
/**
 * The paper's numbers for it, if it has any.
 */
paper: PaperRow | null, 
/**
 * Sub-controller 2.
 */
controller: ControllerName, map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, 
/**
 * Name of the program, with the controller `program`.
 */
program: string | null, 
/**
 * What varied parameters are in this cell.
 */
varied: Array<Setting>, };

/**
 * An evaluation without its rows.
 */
export type EvaluationSummary = { id: string, query: EvaluationQuery, stage: JobStage, 
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

/**
 * Answer of `GET /api/evaluations`.
 */
export type Evaluations = { 
/**
 * In the order of submission.
 */
evaluations: Array<EvaluationSummary>, };
