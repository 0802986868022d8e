// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Parameters } from '../parameters.gen';
import type { ComparisonMessage } from './comparison.gen';
import type { ControllerName, Disturbance, Polygon, PositionerKind, Rect, Scenario, Scripted } from './experiment.gen';
import type { OverlayMessage, SeenMessage } from './layers.gen';

/**
 * A message from a browser. Positions are in metres in `base`.
 */
export type ClientMessage = { "type": "set_goal", x_m: number, y_m: number, } | { "type": "clear_goal", } | { "type": "drag", x_m: number, y_m: number, lift?: boolean, } | { "type": "release", } | { "type": "select_controller", controller: ControllerName, } | { "type": "configure", parameters: Parameters, } | { "type": "run", } | { "type": "pause", } | { "type": "step", ticks: number, } | { "type": "set_speed", factor: number, } | { "type": "reset", seed?: number, } | { "type": "load_scenario", map: string, controller?: ControllerName, positioner?: PositionerKind, seed?: number | string, start_m?: [number, number], goal_m?: [number, number], parameters?: Parameters, disturbances?: number, script?: Array<Scripted>, } | { "type": "disturb", disturbance: Disturbance, } | { "type": "rewind", tick: number, } | { "type": "fork", tick: number, controllers?: Array<ControllerName>, } | { "type": "take_control", } | { "type": "release_control", };

/**
 * Role of a browser.
 */
export type Role = "operator" | "viewer";

/**
 * What the server sends as text.
 */
export type ServerMessage = { "type": "hello" } & Hello | { "type": "scene" } & SceneMessage | { "type": "state" } & StateMessage | { "type": "event" } & EventMessage | { "type": "overlay" } & OverlayMessage | { "type": "seen" } & SeenMessage | { "type": "comparison" } & ComparisonMessage | { "type": "error" } & ErrorMessage;

/**
 * See `ServerMessage::Hello`.
 */
export type Hello = { 
/**
 * `PROTOCOL_VERSION`.
 */
protocol: number, 
/**
 * Name of the session.
 */
session: string, 
/**
 * Ferry's version.
 */
version: string, 
/**
 * This browser's role.
 */
role: Role, 
/**
 * Number of the operator's lease; it increases when another browser becomes the operator. A command may carry it
 * as `epoch`, and is refused if it is not the current one.
 */
epoch: number, 
/**
 * Whether the session has an operator.
 */
operator_present: boolean, 
/**
 * Whether this browser is the operator and another one requests control.
 */
asked: boolean, 
/**
 * Graphics adapter that renders the camera.
 */
adapter: string, };

/**
 * See `ServerMessage::Scene`.
 */
export type SceneMessage = { 
/**
 * Name of the map.
 */
map: string, 
/**
 * Maps that `load_scenario` accepts.
 */
maps: Array<string>, 
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
 * Joint angles; `null` for the planar stage.
 */
joints_rad: [number, number, number, number, number, number] | null, 
/**
 * Active sub-controller, 1 or 2.
 */
mode: number, 
/**
 * Why it is active, in one sentence.
 */
reason: string, 
/**
 * Why the arm holds, if a step was refused.
 */
refusal: string | null, 
/**
 * Sub-controller 2 in use.
 */
controller: ControllerName, 
/**
 * Phase: `holding`, `approaching`, `transporting`, `settling`, `delivered`, `lifted off`, `stopped`.
 */
phase: string, 
/**
 * Tool minus bead, x.
 */
tracking_error_x_m: number, 
/**
 * Tool minus bead, y.
 */
tracking_error_y_m: number, 
/**
 * Norm of the tracking error.
 */
tracking_error_m: number, 
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
 * Hash of the plant's state, in hex.
 */
world_hash: string, 
/**
 * `recording`, or why nothing is recorded.
 */
recording: string, 
/**
 * Why the session ended, if it has.
 */
ended: string | null, };

/**
 * Kinds of event, for the timeline.
 */
export type EventKind = "switch" | "disturbance" | "goal" | "reached" | "delivered" | "lift_off" | "refused" | "stopped" | "session";

/**
 * See `ServerMessage::Event`.
 */
export type EventMessage = { tick: number, sim_time_s: number, kind: EventKind, 
/**
 * One sentence.
 */
text: string, };

/**
 * See `ServerMessage::Error`; an HTTP problem has the same fields.
 */
export type ErrorMessage = { 
/**
 * For programs, such as `in_wall`.
 */
code: string, 
/**
 * For people: names the field and the value.
 */
message: string, field?: string, };
