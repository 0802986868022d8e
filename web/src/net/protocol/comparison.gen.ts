// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { ControllerName } from './experiment.gen';
import type { PhaseFact, Reason, RefusalFact, Told, TroubleFact } from './facts.gen';
import type { OverlayMessage } from './layers.gen';

/**
 * One controller's run in a comparison.
 */
export type Branch = { controller: ControllerName, 
/**
 * Name of the program, with the controller `program`.
 */
program: string | null, 
/**
 * Tool x, y and bead x, y in metres, from the first sample after the moment.
 */
samples: Array<[number, number, number, number]>, 
/**
 * Whether it has ended.
 */
done: boolean, 
/**
 * Last phase, as in the state; `null` before the first tick.
 */
phase: Told<PhaseFact> | null, 
/**
 * Tick of the first delivery after the moment.
 */
delivered_tick: number | null, 
/**
 * Mean distance of tool and bead during transport.
 */
tracking_error_mean_m: number, 
/**
 * Maximum difference in x during transport.
 */
tracking_error_max_x_m: number, 
/**
 * The same in y.
 */
tracking_error_max_y_m: number, 
/**
 * Control steps since the moment.
 */
steps: number, 
/**
 * Switches since the moment.
 */
switches: number, };

/**
 * A comparison: one moment continued under several controllers, from the same state with the same disturbances.
 */
export type ComparisonMessage = { 
/**
 * Number of the trial, as in the scene.
 */
trial: number, 
/**
 * Tick of the moment.
 */
tick: number, 
/**
 * The tick in seconds.
 */
sim_time_s: number, 
/**
 * Tick at which branches end at the latest.
 */
until_tick: number, 
/**
 * Sub-controller 2 at that moment; its branch repeats the session, and goes on where that ran out of steps.
 */
controller: ControllerName, 
/**
 * Ticks between two samples.
 */
ticks_a_sample: number, 
/**
 * Whether branches still run.
 */
running: boolean, 
/**
 * Why it failed, if it did.
 */
failed: string | null, 
/**
 * One branch per controller, in the requested order; branches that have not started are omitted.
 */
branches: Array<Branch>, };

/**
 * Answer of `GET /api/sessions/{id}/moments/{tick}`: the repeated control step at or before a tick.
 */
export type MomentMessage = { 
/**
 * Tick of the control step.
 */
tick: number, 
/**
 * The tick in seconds.
 */
sim_time_s: number, 
/**
 * Active sub-controller after the step, 1 or 2.
 */
mode: number, 
/**
 * Whether the step switched the sub-controller.
 */
switched: boolean, 
/**
 * Why it is active.
 */
reason: Told<Reason>, 
/**
 * e: distance from tool to tracked bead in the plane.
 */
error_m: number, 
/**
 * The limit for e: T, or the fetch radius during a fetch.
 */
threshold_m: number, 
/**
 * Sub-controller 2 in use.
 */
controller: ControllerName, 
/**
 * What the trial does, as in the state.
 */
phase: Told<PhaseFact>, 
/**
 * Tool point.
 */
tool_m: [number, number], 
/**
 * True position of the bead.
 */
bead_m: [number, number], 
/**
 * Position of the bead from the tracker.
 */
bead_tracked_m: [number, number], 
/**
 * Goal, if set.
 */
goal_m: [number, number] | null, 
/**
 * Next tool target, if any.
 */
target_m: [number, number] | null, 
/**
 * Why the arm holds, if a step was refused.
 */
refusal: Told<RefusalFact> | null, 
/**
 * What keeps the controller from the goal, if anything.
 */
trouble: Told<TroubleFact> | null, 
/**
 * The controller's observation and layers.
 */
overlay: OverlayMessage, };
