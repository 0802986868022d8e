// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

/**
 * A closed outline: one entry per vertex in each list.
 */
export type WallRing = { 
/**
 * Where the wall is at rest.
 */
place_m: Array<[number, number]>, 
/**
 * Coordinate along the lumen.
 */
along_m: Array<number>, 
/**
 * The most that it closes in.
 */
limit_m: Array<number>, };

/**
 * The lumen of a session's map. What the walls cover beyond their drawn place is a disc around each point of it, of the
 * radius `min(wave, limit_m, room)` at vertices and linear between them. The wave is `StateMessage.wave_m`, interpolated
 * between knots at `along_m / knot_m`; `room` is the distance from the bead's surface, at least 0: walls stop at the bead.
 */
export type Lumen = { 
/**
 * Name of the map.
 */
map: string, 
/**
 * Spacing of the knots along the lumen.
 */
knot_m: number, 
/**
 * Closed outlines of the free space, which is on their left.
 */
rings: Array<WallRing>, };
