// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Parameters } from '../parameters.gen';
import type { AttemptStanding } from './challenges.gen';
import type { ControllerName, Polygon, PositionerKind, Rect, Scenario } from './experiment.gen';
import type { EndFact, PhaseFact, Reason, RecordingFact, RefusalFact, Told, TroubleFact } from './facts.gen';
import type { ProgramStanding } from './programs.gen';
import type { RobotStanding, TwinStanding } from './robot.gen';

/**
 * What `/s/NAME/VIEW` shows instead of the laboratory.
 */
export type View = "draw" | "train" | "recordings" | "evaluate";

/**
 * See `ServerMessage::Scene`.
 */
export type SceneMessage = { 
/**
 * Name of the map.
 */
map: string, 
/**
 * The trial's scenario; controller, goal and parameters may have changed since.
 */
scenario: Scenario, 
/**
 * The positioner of this trial.
 */
positioner: PositionerKind, 
/**
 * Controllers that `select_controller` accepts.
 */
controllers: Array<ControllerName>, workspace: Rect, 
/**
 * Walls inside the workspace, 5 mm high.
 */
walls: Array<Polygon>, seed: number, parameters: Parameters, defaults: Parameters, bead_radius_m: number, 
/**
 * Corners of the part of the table that the camera sees, relative to the tool.
 */
camera_sees_m: Array<[number, number]>, 
/**
 * Kept runs, oldest first: what rewinds, resets and other scenarios have left behind.
 */
kept_runs: Array<KeptRun>, 
/**
 * The test case that was opened for this trial.
 */
case: CaseSummary | null, 
/**
 * Name of the challenge that is being played.
 */
challenge: string | null, 
/**
 * Number of the trial; each new trial has another one.
 */
trial: number, 
/**
 * Distances from the tool at which the magnet's pull beats friction, nearest and farthest, for the
 * current parameters, in 72 directions from +x counter-clockwise; `null` if it never does, and no
 * farthest distance if it always does.
 */
capture_m: Array<[number, number | null] | null>, 
/**
 * Seconds per tick.
 */
tick_s: number, };

/**
 * A run that `return_to` accepts.
 */
export type KeptRun = { number: number, 
/**
 * Name of its map.
 */
map: string, seed: number, 
/**
 * Sub-controller 2 at its end.
 */
controller: ControllerName, 
/**
 * Time at its end.
 */
sim_time_s: number, deliveries: number, };

/**
 * An opened test case: its inputs come at their ticks.
 */
export type CaseSummary = { 
/**
 * Description, possibly shortened.
 */
about: string, 
/**
 * Number of inputs.
 */
inputs: number, 
/**
 * Tick of the last input; 0 without inputs.
 */
last_tick: number, 
/**
 * Expected deliveries since the start, up to `by_tick`; omitted if the case expects nothing.
 */
deliveries?: number, by_tick?: number, };

/**
 * See `ServerMessage::State`.
 */
export type StateMessage = { 
/**
 * Ticks since the start of the trial.
 */
tick: number, 
/**
 * `tick` in seconds.
 */
sim_time_s: number, 
/**
 * Earliest tick that `rewind` reaches.
 */
oldest_tick: number, 
/**
 * Latest tick that `rewind` reaches.
 */
newest_tick: number, 
/**
 * Whether the session is running.
 */
running: boolean, 
/**
 * Requested speed, simulated seconds per second.
 */
speed_target: number, 
/**
 * Achieved speed, simulated seconds per second.
 */
speed_achieved: number, 
/**
 * Maximum delay of a tick in the last half second, wall-clock milliseconds.
 */
lateness_ms: number, 
/**
 * How often the session fell behind so far that it skipped the lost time.
 */
missed_deadlines: number, 
/**
 * Tool point: the middle of the block's lower face.
 */
tool_m: [number, number, number], 
/**
 * True centre of the bead.
 */
bead_m: [number, number, number], 
/**
 * Position of the bead from the tracker.
 */
bead_tracked_m: [number, number], 
/**
 * Goal, if one is set.
 */
goal_m: [number, number, number] | null, 
/**
 * Target of the hand, while it holds the bead.
 */
hand_m: [number, number] | null, 
/**
 * Force of the hand's spring on the bead; 0 if not held.
 */
hand_force_n: number, 
/**
 * Where a person points the tool, with the controller `you`.
 */
steer_m: [number, number] | null, 
/**
 * Joint angles; `null` for the planar stage.
 */
joints_rad: [number, number, number, number, number, number] | null, 
/**
 * Active sub-controller, 1 or 2.
 */
mode: number, 
/**
 * Why it is active.
 */
reason: Told<Reason>, 
/**
 * Why the arm holds, if a step was refused.
 */
refusal: Told<RefusalFact> | null, 
/**
 * Why sub-controller 2 makes no progress, if it makes none.
 */
trouble: Told<TroubleFact> | null, 
/**
 * Sub-controller 2 in use.
 */
controller: ControllerName, 
/**
 * What the trial does now.
 */
phase: Told<PhaseFact>, 
/**
 * Tool minus bead, x.
 */
tracking_error_x_m: number, 
/**
 * Tool minus bead, y.
 */
tracking_error_y_m: number, 
/**
 * Norm of the tracking error: the true distance between tool and bead in the plane.
 */
tracking_error_m: number, 
/**
 * Distance between the tool and the tracked bead in the plane: e of the switching law, as it would be now.
 */
tracked_error_m: number, 
/**
 * Distance from the tool to the goal.
 */
goal_distance_m: number | null, 
/**
 * Horizontal pull of the magnet on the bead.
 */
pull_n: number, 
/**
 * Vertical pull in units of the bead's weight; the bead lifts off at 1.
 */
lift_ratio: number, 
/**
 * How far walls close in along the lumen, one number per knot of `Lumen`; omitted while they are at rest.
 */
wave_m?: Array<number>, 
/**
 * Control steps of the current transport leg.
 */
leg_steps: number, 
/**
 * Control steps of the trial.
 */
steps: number, 
/**
 * Switches of the trial.
 */
switches: number, 
/**
 * Goals delivered since the reset.
 */
deliveries: number, 
/**
 * Disturbances by hand or script since the reset.
 */
disturbances: number, 
/**
 * The attempt at the challenge that is being played.
 */
attempt: AttemptStanding | null, 
/**
 * The program that was selected last.
 */
program: ProgramStanding | null, 
/**
 * The clients of the robot server; `null` if this session has none.
 */
robot: RobotStanding | null, 
/**
 * The robot outside of Ferry that the arm mirrors; `null` without one.
 */
twin: TwinStanding | null, 
/**
 * Hash of the plant's state, in hex.
 */
world_hash: string, 
/**
 * Whether everything is recorded, or why not.
 */
recording: Told<RecordingFact>, 
/**
 * Why the session ended, if it has.
 */
ended: Told<EndFact> | null, };
