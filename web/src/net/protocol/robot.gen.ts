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
