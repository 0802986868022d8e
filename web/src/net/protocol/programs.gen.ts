// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

/**
 * A program that decides control steps.
 */
export type ProgramStanding = { name: string, is_connected: boolean, 
/**
 * Answers since it connected.
 */
answers: number, 
/**
 * Control steps for which no usable answer came in time, since it connected.
 */
missed: number, 
/**
 * Time to the last answer; `null` before the first.
 */
latency_s: number | null, };

/**
 * Answer of `GET /api/controllers`.
 */
export type Programs = { 
/**
 * By name; also those that have disconnected.
 */
programs: Array<ProgramStanding>, };
