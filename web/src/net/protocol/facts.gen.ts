// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { ControllerName } from './experiment.gen';

/**
 * A fact with its sentence.
 */
export type Told<T> = { 
/**
 * One sentence in English.
 */
text: string, } & T;

/**
 * What the trial does now.
 */
export type PhaseFact = { "code": "holding" } | { "code": "approaching" } | { "code": "transporting" } | { "code": "settling" } | { "code": "delivered" } | { "code": "lifted_off" } | { "code": "stopped", by: StopCode, 
/**
 * The limit, where it is one of steps.
 */
steps?: number, };

/**
 * The limit that stopped a trial.
 */
export type StopCode = "leg_steps" | "goal_steps" | "tracker_lost" | "settle" | "walled_off";

/**
 * Why sub-controller 2 makes no progress.
 */
export type TroubleFact = { "code": "saddle" } | { "code": "circling" } | { "code": "inside_obstacle" } | { "code": "refused" } | { "code": "searching" } | { "code": "walled_off" } | { "code": "closed" };

/**
 * Why an attempt at a challenge does not count.
 */
export type VoidFact = { "code": "paused" } | { "code": "speed" } | { "code": "rewound" } | { "code": "other_input" };

/**
 * Why the arm holds.
 */
export type RefusalFact = { "code": "not_finite" } | { "code": "outside_workspace", x_m: number, y_m: number, } | { "code": "out_of_reach", distance_m: number, min_m: number, max_m: number, } | { "code": "singular", manipulability_m3: number, least_m3: number, } | { "code": "no_inverse" } | { "code": "too_fast", speed_m_s: number, limit_m_s: number, } | { "code": "tracker_lost", is_searching: boolean, } | { "code": "policy", detail: string, } | { "code": "program", detail: string, } | { "code": "searching", attempts: number, } | { "code": "walled_off" } | { "code": "closed" } | { "code": "out_of_view", x_m: number, y_m: number, } | { "code": "hidden", x_m: number, y_m: number, } | { "code": "obstacle", x_m: number, y_m: number, };

/**
 * Why a sub-controller is active.
 */
export type Reason = { "code": "lost", error_m: number, threshold_m: number, } | { "code": "wall_between", error_m: number, } | { "code": "fetching", error_m: number, threshold_m: number, } | { "code": "fetched", error_m: number, threshold_m: number, } | { "code": "held", error_m: number, threshold_m: number, } | { "code": "lifted_off" };

/**
 * What has happened.
 */
export type Happening = { "code": "took_over", sub_controller: number, reason: Told<Reason>, } | { "code": "taken" } | { "code": "placed", distance_m: number, } | { "code": "released" } | { "code": "displaced", distance_m: number, } | { "code": "kicked", impulse_n_s: number, } | { "code": "pushed", force_n: number, for_s: number, } | { "code": "blinded", for_s: number, } | { "code": "not_disturbed" } | { "code": "goal_placed", x_m: number, y_m: number, } | { "code": "goal_removed" } | { "code": "reached" } | { "code": "delivered", distance_m: number, } | { "code": "lifted_off" } | { "code": "step_refused", refusal: Told<RefusalFact>, 
/**
 * Whether the arm holds; it does not while it looks for the bead.
 */
is_holding: boolean, } | { "code": "tracker_back" } | { "code": "stopped", phase: Told<PhaseFact>, } | { "code": "controller_selected", controller: ControllerName, } | { "code": "set_up", map: string, seed: number, 
/**
 * Inputs of the test case, if one was opened.
 */
inputs?: number, } | { "code": "took_up", about: string, } | { "code": "returned", run: number, } | { "code": "inputs_left_out", count: number, detail: string, } | { "code": "resumed", how: Resumption, 
/**
 * What could not be read.
 */
lost?: string, } | { "code": "robot", is_client: boolean, is_refused: boolean, detail: string, };

/**
 * How an interrupted session goes on.
 */
export type Resumption = "goes_on" | "started_over" | "started_over_with_runs";

/**
 * Why a command was refused, for programs. `values` has what it is about.
 */
export type RefusalCode = "malformed" | "not_operator" | "kept" | "stale_epoch" | "out_of_range" | "not_finite" | "long_reason" | "outside_workspace" | "in_wall" | "out_of_reach" | "parameter_out_of_range" | "disturbance_out_of_range" | "not_you" | "not_robot" | "not_program" | "joints_refused" | "hand_silent" | "too_many_wait" | "map_refused" | "unknown_policy" | "bad_script" | "trial_failed" | "bad_case" | "other_drawing" | "no_challenge" | "no_run" | "nothing_carried" | "forgotten" | "no_program" | "no_try" | "no_training" | "no_goal" | "no_robot" | "robot_refused" | "busy" | "unanswered" | "ended";

/**
 * Whether a trial is recorded. `detail` is what the system says, in English.
 */
export type RecordingFact = { "code": "on" } | { "code": "slow", lost_ticks: number, } | { "code": "interrupted", detail: string, } | { "code": "stopped", detail: string, } | { "code": "refused", detail: string, } | { "code": "off" };

/**
 * Why a session ended. `detail` is what the simulator says, in English.
 */
export type EndFact = { "code": "trial_failed", detail: string, } | { "code": "crashed", detail: string, };
