// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

export type JobStage = "waiting" | "running" | "paused" | "done" | "cancelled" | "failed";

export type JobKind = "evaluation" | "recovery" | "training" | "comparison";

/**
 * A line of jobs, in which one runs and the others wait. Short jobs run beside long ones.
 */
export type JobLane = "short" | "long";

/**
 * A job in the background: waiting, running or paused, or ended in the last ten minutes.
 */
export type JobSummary = { 
/**
 * That of the evaluation, recovery map or training, too.
 */
id: string, kind: JobKind, 
/**
 * Name of a training's policy, otherwise the maps.
 */
name: string, 
/**
 * The session that started it; `null`: a program did, by the API.
 */
owner: string | null, lane: JobLane, stage: JobStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * While it waits: the number of jobs before it in its lane.
 */
before: number, 
/**
 * While it waits: estimated time until these have ended.
 */
starts_in_s: number | null, 
/**
 * Share of its work that is done, 0 to 1.
 */
share: number, 
/**
 * Estimate of the whole job before its start.
 */
estimate_s: number, 
/**
 * Estimated time that it still runs; `null` after its end.
 */
left_s: number | null, can_pause: boolean, 
/**
 * Whether there is something to show: a row, a trial, a value map or a branch.
 */
has_results: boolean, };

/**
 * How long a unit of work takes on this machine: guessed, then measured.
 */
export type JobPace = { 
/**
 * A trial of an evaluation (`evaluation_rl`, for each controller) or of a recovery map (`recovery`), an update of a
 * training (`training_quick`, for each recipe), a branch of a comparison (`comparison`).
 */
work: string, each_s: number, };
