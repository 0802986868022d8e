// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

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
stop: string | null, 
/**
 * Newest last, at most 20.
 */
refused: Array<RobotRefusal>, };

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
trouble: string | null, 
/**
 * What its dashboard says that it is; `null` if it does not say.
 */
model: string | null, 
/**
 * Why places on the table may be others than Ferry's; `null` if there is no reason to think so.
 */
doubt: string | null, 
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
stopped: string | null, };
