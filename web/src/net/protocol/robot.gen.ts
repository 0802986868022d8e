// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Told } from './facts.gen';

/**
 * A connection.
 */
export type RobotClient = { 
/**
 * Address and port.
 */
from: string, 
/**
 * `dashboard`, `URScript` or `RTDE`.
 */
speech: string, };

/**
 * Why the arm is in a protective stop.
 */
export type ProtectiveStop = { "code": "requested" } | { "code": "refused", detail: string, };

/**
 * What was refused, and why.
 */
export type RobotRefusal = { tick: number, what: string, why: string, };

/**
 * Who is connected to the robot server, what moves the arm, and what was refused.
 */
export type RobotStanding = { clients: Array<RobotClient>, 
/**
 * The program that runs.
 */
program: string | null, 
/**
 * URScript's name of the motion, while there is one.
 */
command: string | null, 
/**
 * Why the arm is in a protective stop.
 */
stop: Told<ProtectiveStop> | null, 
/**
 * Newest last, at most 20.
 */
refused: Array<RobotRefusal>, };

/**
 * Where the robot and Ferry say that one part of the arm is.
 */
export type ApartFact = { 
/**
 * Position in metres and rotation vector in radians, as URScript writes a pose.
 */
reported: [number, number, number, number, number, number], computed: [number, number, number, number, number, number], distance_m: number, angle_rad: number, };

/**
 * Why places on the table may be others than Ferry's.
 */
export type DoubtFact = { "code": "tool" } & ApartFact | { "code": "flange" } & ApartFact;

/**
 * Why a robot does not follow. `detail` is an English sentence.
 */
export type DriveFact = { "code": "not_enabled" } | { "code": "not_connected" } | { "code": "mode", robot_mode: number, } | { "code": "safety", safety_mode: number, } | { "code": "busy" } | { "code": "place", detail: string, } | { "code": "other_arm" } & ApartFact | { "code": "no_arm" } | { "code": "not_begun" } | { "code": "not_sent", detail: string, } | { "code": "silent" } | { "code": "over" } | { "code": "behind", joint: number, behind_rad: number, } | { "code": "limit", detail: string, } | { "code": "refused", detail: string, } | { "code": "changed" } | { "code": "released" };

/**
 * Why a robot is not connected. `detail` is what the system says, in English.
 */
export type TwinTrouble = { "code": "not_yet" } | { "code": "failed", detail: string, };

/**
 * A robot outside of Ferry (`ferry drive`), whose arm the simulated one mirrors.
 */
export type TwinStanding = { address: string, 
/**
 * Whether Ferry may move it (`--enable-motion`).
 */
allows_motion: boolean, 
/**
 * Why it is not connected; `null` if it is.
 */
trouble: Told<TwinTrouble> | null, 
/**
 * What its dashboard says that it is; `null` if it does not say.
 */
model: string | null, 
/**
 * Why places on the table may be others than Ferry's; `null` if there is no reason to think so.
 */
doubt: Told<DoubtFact> | null, 
/**
 * As it reports it: 7 while it runs.
 */
robot_mode: number, 
/**
 * As it reports it: 1 normal, 2 reduced, 3 protective stop.
 */
safety_mode: number, 
/**
 * Whether the button is held and the robot begins to follow, or follows.
 */
is_held: boolean, 
/**
 * Whether it follows Ferry's controllers.
 */
is_driven: boolean, 
/**
 * Why it does not follow, or no longer.
 */
stopped: Told<DriveFact> | null, };
