// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { ControllerName } from './experiment.gen';
import type { JobStage } from './jobs.gen';

/**
 * How the trials of a recovery map are disturbed.
 */
export type RecoveryKind = "place" | "push" | "drag" | "blind";

/**
 * How a trial ended.
 */
export type RecoveryOutcome = "delivered" | "late" | "lost";

/**
 * Body of `POST /api/recoveries`. The moment is one of a session, or the start of a scenario or of a random trial.
 */
export type RecoveryQuery = { 
/**
 * Name of a session. Without it, and without a scenario and a map, it is `main`.
 */
session?: string, 
/**
 * A tick of the session; omitted: now.
 */
tick?: number, 
/**
 * Name of a shipped scenario.
 */
scenario?: string, 
/**
 * Name of a map, shipped or added; start and goal are drawn from the seed.
 */
map?: string, kind: RecoveryKind, 
/**
 * Sub-controllers 2; `program` is the program that is selected in the session.
 */
controllers: Array<ControllerName>, 
/**
 * Number of columns of the finest grid: of places, directions or times.
 */
grid: number, 
/**
 * Trials per cell and controller, each with its own noise.
 */
repeats: number, 
/**
 * Seed of the noise.
 */
seed: number, 
/**
 * A later delivery is late; simulated seconds.
 */
within_s: number, 
/**
 * Whether each cell of the finest grid is tried, also where all neighbours agree.
 */
full: boolean, };

/**
 * A recovery map without its cells.
 */
export type RecoverySummary = { id: string, stage: JobStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * Number of trials that have ended.
 */
done: number, 
/**
 * Number of trials that are planned; it grows where cells are divided.
 */
planned: number, 
/**
 * The session of its moment, if it has one, and the number of the trial there, as in the scene.
 */
session: string | null, trial: number | null, map: string, kind: RecoveryKind, 
/**
 * Sub-controllers 2.
 */
controllers: Array<ControllerName>, 
/**
 * Their names, or that of the program.
 */
names: Array<string>, grid: number, repeats: number, seed: number, within_s: number, 
/**
 * Tick of the moment.
 */
tick: number, 
/**
 * True position of the bead at the moment.
 */
bead_m: [number, number], goal_m: [number, number] | null, };

/**
 * The trials of one controller in one cell.
 */
export type RecoveryCell = { 
/**
 * Number of the cell.
 */
cell: number, 
/**
 * Centre and size of a square of places.
 */
x_m: number | null, y_m: number | null, size_m: number | null, 
/**
 * Direction of a push or drag, counter-clockwise from x.
 */
direction_rad: number | null, 
/**
 * Force of a push in newtons, length of a drag in metres, duration of a loss in seconds.
 */
strength: number | null, 
/**
 * When the tracker becomes blind, after the moment.
 */
at_s: number | null, 
/**
 * Name of the controller, or of the program.
 */
controller: string, delivered: number, 
/**
 * Delivered, but after more than `within_s`.
 */
late: number, lost: number, 
/**
 * Trials that have ended.
 */
repeats: number, 
/**
 * Wilson 95 % interval of `delivered / repeats`.
 */
delivered_wilson95: [number, number], 
/**
 * Median time to the delivery, with late ones.
 */
time_s_median: number | null, 
/**
 * How most of the lost trials ended.
 */
why: string | null, };

/**
 * The part of a map from which a controller delivers in time.
 */
export type Basin = { controller: string, 
/**
 * Trials that have ended.
 */
trials: number, delivered: number, 
/**
 * Share of the map's area, or of all pushes, drags or losses.
 */
share: number, 
/**
 * Its Wilson 95 % interval.
 */
share95: [number, number], 
/**
 * Area of the basin; only for places.
 */
area_m2: number | null, area95_m2: [number, number] | null, };

/**
 * The basin of one controller minus that of another, at the same cells with the same noise.
 */
export type BasinDifference = { controller: string, against: string, 
/**
 * Trials delivered by both, by the first only, by the second only, and by neither.
 */
both: number, first_only: number, second_only: number, neither: number, share_difference: number, 
/**
 * Its 95 % interval (Newcombe 1998, method 10).
 */
share_difference95: [number, number], 
/**
 * The interval at the level that is corrected for the number of differences (Bonferroni).
 */
share_difference_corrected: [number, number], 
/**
 * Difference of the areas; only for places.
 */
area_difference_m2: number | null, };

/**
 * Answer of `GET /api/recoveries/{id}`.
 */
export type RecoveryReport = { 
/**
 * One per cell and controller with a trial that has ended.
 */
cells: Array<RecoveryCell>, basins: Array<Basin>, differences: Array<BasinDifference>, id: string, stage: JobStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * Number of trials that have ended.
 */
done: number, 
/**
 * Number of trials that are planned; it grows where cells are divided.
 */
planned: number, 
/**
 * The session of its moment, if it has one, and the number of the trial there, as in the scene.
 */
session: string | null, trial: number | null, map: string, kind: RecoveryKind, 
/**
 * Sub-controllers 2.
 */
controllers: Array<ControllerName>, 
/**
 * Their names, or that of the program.
 */
names: Array<string>, grid: number, repeats: number, seed: number, within_s: number, 
/**
 * Tick of the moment.
 */
tick: number, 
/**
 * True position of the bead at the moment.
 */
bead_m: [number, number], goal_m: [number, number] | null, };

/**
 * Answer of `GET /api/recoveries`.
 */
export type Recoveries = { 
/**
 * In the order of submission.
 */
recoveries: Array<RecoverySummary>, };

/**
 * A trial of a recovery map.
 */
export type RecoveryTrial = { controller: ControllerName, 
/**
 * From 0.
 */
repeat: number, outcome: RecoveryOutcome, 
/**
 * From the moment to the delivery, or to the end of the trial.
 */
time_s: number, 
/**
 * Control steps since the moment.
 */
steps: number, 
/**
 * Phase at the end.
 */
phase: string, 
/**
 * The last tick, and hashes of the state after it.
 */
tick: number, world_hash: string, controller_hash: string, };

/**
 * Answer of `GET /api/recoveries/{id}/cells/{cell}`.
 */
export type RecoveryTrials = { 
/**
 * The trials of the cell that have ended.
 */
trials: Array<RecoveryTrial>, };
