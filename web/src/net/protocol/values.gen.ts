// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

/**
 * Body of `POST /api/sessions/{id}/values`.
 */
export type ValueQuery = { goal_m: [number, number], 
/**
 * Number of the page's last `seen` message. The server ignores it; it makes the request a new one
 * when more was observed.
 */
seen?: number, };

/**
 * One cell of a [`ValueMap`].
 */
export type ValueCell = { 
/**
 * Centre of the cell.
 */
center_m: [number, number], 
/**
 * Value of the best action.
 */
value: number, 
/**
 * Index of the best action: +x, −x, +y, −y.
 */
action: number, };

/**
 * Values of the session's policy for every place of the map and one goal. Without a memory they come from images of the
 * default camera, with places a centimetre apart, farther where there would be more than 4000. A policy with a memory
 * judges all places where it may be, by what the session's camera has seen so far.
 */
export type ValueMap = { 
/**
 * Side of a cell.
 */
spacing_m: number, 
/**
 * Cells with at least the policy's clearance from walls; with a memory, from walls that were seen.
 */
cells: Array<ValueCell>, 
/**
 * Maps that the policy was trained on.
 */
trained_on: Array<string>, 
/**
 * Whether the values are those of what the session's camera has seen so far.
 */
has_memory: boolean, };
