// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Parameters } from '../parameters.gen';
import type { ChallengeSummary } from './challenges.gen';
import type { ComparisonMessage } from './comparison.gen';
import type { EvaluationSummary } from './evaluations.gen';
import type { ControllerName, Disturbance, PositionerKind, Scripted } from './experiment.gen';
import type { Happening, RefusalCode, Told } from './facts.gen';
import type { JobPace, JobSummary } from './jobs.gen';
import type { OverlayMessage, SeenMessage } from './layers.gen';
import type { PolicySummary } from './policies.gen';
import type { ProgramStanding } from './programs.gen';
import type { RecoverySummary } from './recoveries.gen';
import type { SceneMessage, StateMessage } from './session.gen';
import type { TrainingPoint, TrainingSummary } from './trainings.gen';

/**
 * A message from a browser. Positions are in metres in `base`.
 */
export type ClientMessage = { "type": "set_goal", x_m: number, y_m: number, } | { "type": "clear_goal", } | { "type": "drag", x_m: number, y_m: number, lift?: boolean, } | { "type": "release", } | { "type": "select_controller", controller: ControllerName, 
/**
 * Name of a program, with the controller `program`. Omitted: the one that was selected last.
 */
program?: string, } | { "type": "configure", parameters: Parameters, } | { "type": "steer", x_m: number, y_m: number, approach?: boolean, } | { "type": "run", } | { "type": "pause", } | { "type": "step", ticks: number, } | { "type": "set_speed", factor: number, } | { "type": "reset", seed?: number, } | { "type": "load_scenario", map: string, controller?: ControllerName, positioner?: PositionerKind, seed?: number | string, start_m?: [number, number], goal_m?: [number, number], parameters?: Parameters, disturbances?: number, script?: Array<Scripted>, } | { "type": "play_challenge", challenge: string, } | { "type": "open_case", case: string, } | { "type": "open_try", 
/**
 * Id of the recovery map.
 */
recovery: string, 
/**
 * Number of the cell.
 */
cell: number, controller: ControllerName, 
/**
 * From 0.
 */
repeat: number, } | { "type": "disturb", disturbance: Disturbance, } | { "type": "rewind", tick: number, } | { "type": "return_to", run: number, } | { "type": "fork", tick: number, controllers?: Array<ControllerName>, } | { "type": "drive_robot", 
/**
 * Another number for each press: one whose motion has ended moves nothing again.
 */
press?: number, } | { "type": "watch_training", 
/**
 * Its id.
 */
training: string | null, } | { "type": "take_control", } | { "type": "keep_control", } | { "type": "release_control", };

/**
 * Role of a browser.
 */
export type Role = "operator" | "viewer";

/**
 * What the server sends as text.
 */
export type ServerMessage = { "type": "hello" } & Hello | { "type": "scene" } & SceneMessage | { "type": "state" } & StateMessage | { "type": "event" } & EventMessage | { "type": "overlay" } & OverlayMessage | { "type": "seen" } & SeenMessage | { "type": "comparison" } & ComparisonMessage | { "type": "catalog" } & CatalogMessage | { "type": "training_points" } & TrainingPointsMessage | { "type": "done" } & DoneMessage | { "type": "refused" } & RefusedMessage | { "type": "error" } & SessionError;

/**
 * See `ServerMessage::Hello`.
 */
export type Hello = { 
/**
 * `PROTOCOL_VERSION`.
 */
protocol: number, 
/**
 * Largest message that this browser may send.
 */
message_bytes: number, 
/**
 * Name of the session.
 */
session: string, 
/**
 * Key of this browser's seat, which no other browser gets. An attempt at a challenge can be put on the board with the
 * key of the seat that began it. Connect again with `?seat=`.
 */
seat: string, 
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
 * Whether the session has an operator, or one whose page may be loading again.
 */
operator_present: boolean, 
/**
 * Whether this browser is the operator and another one requests control.
 */
asked: boolean, 
/**
 * Whether this browser requests control.
 */
asks: boolean, 
/**
 * Requests of other browsers that are answered before that of this one.
 */
ahead: number, 
/**
 * During a request: seconds until the operator loses control if it does nothing. Each of its commands begins them again.
 */
answer_within_s: number | null, 
/**
 * Graphics adapter that renders the camera.
 */
adapter: string, 
/**
 * When this server opened the session. It changes when the server was restarted or the session opened again.
 */
opened: string, 
/**
 * Time of the trial at which the session went on from what was saved; `null` if it began with its scenario.
 */
resumed_s: number | null, };

/**
 * Kinds of event, for the timeline.
 */
export type EventKind = "switch" | "disturbance" | "goal" | "reached" | "delivered" | "lift_off" | "refused" | "stopped" | "session";

/**
 * See `ServerMessage::Event`.
 */
export type EventMessage = { tick: number, sim_time_s: number, kind: EventKind, what: Told<Happening>, 
/**
 * Part of the past of a run that the session has returned to; omitted otherwise.
 */
again?: boolean, };

/**
 * See `ServerMessage::Error`.
 */
export type SessionError = { code: RefusalCode, 
/**
 * For people: names the field and the value.
 */
message: string, field?: string, 
/**
 * What was refused, by name.
 */
values: Record<string, unknown>, };

/**
 * A list of the server, whole, with the items of its HTTP resource.
 */
export type CatalogMessage = { "list": "maps", "items": Array<string> } | { "list": "policies", "items": Array<PolicySummary> } | { "list": "trainings", "items": Array<TrainingSummary> } | { "list": "evaluations", "items": Array<EvaluationSummary> } | { "list": "recoveries", "items": Array<RecoverySummary> } | { "list": "programs", "items": Array<ProgramStanding> } | { "list": "challenges", "items": Array<ChallengeSummary> } | { "list": "jobs", "items": Array<JobSummary> } | { "list": "paces", "items": Array<JobPace> };

/**
 * Points of the training that this browser watches.
 */
export type TrainingPointsMessage = { 
/**
 * Id of the training.
 */
training: string, 
/**
 * Number of points before these, 0 in the first message. Those that came after them before are replaced: a training
 * that failed goes on from an earlier point.
 */
first: number, points: Array<TrainingPoint>, };

/**
 * See `ServerMessage::Done`.
 */
export type DoneMessage = { 
/**
 * That of the message.
 */
id: number, 
/**
 * The trial that is shown then, as in the scene.
 */
trial: number, };

/**
 * See `ServerMessage::Refused`.
 */
export type RefusedMessage = { 
/**
 * That of the message.
 */
id: number, code: RefusalCode, 
/**
 * The field of the message that it is about.
 */
field?: string, 
/**
 * What was refused, by name.
 */
values: Record<string, unknown>, 
/**
 * One sentence in English.
 */
detail: string, };
