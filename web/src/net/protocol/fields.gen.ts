// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Orientation, ToolOrientation } from '../parameters.gen';
import type { Rect } from './experiment.gen';

/**
 * Query of `pull`.
 */
export type PullQuery = { 
/**
 * Orientation of the block.
 */
orientation: Orientation, 
/**
 * Its lower face above the table, m: at least the bead's diameter.
 */
lower_face_height_m: number, 
/**
 * Direction of the bead from below the block's middle: from the block's x toward its y.
 */
direction_rad: number, 
/**
 * Coulomb's coefficient.
 */
friction: number, 
/**
 * Maximum offset, m.
 */
farthest_m: number, 
/**
 * Number of evenly spaced offsets, starting at zero.
 */
count: number, };

/**
 * The pull on a bead over its horizontal offset; every array has one entry per offset.
 */
export type PullCurve = { 
/**
 * Offset from below the block's middle, m.
 */
offset_m: Array<number>, 
/**
 * Fz/W: 1 lifts the bead.
 */
lift_ratio: Array<number>, 
/**
 * Pull in the table's plane over W.
 */
lateral_ratio: Array<number>, 
/**
 * (W − Fz)/W: the remaining weight.
 */
weight_ratio: Array<number>, 
/**
 * Whether the bead lifts off because no weight remains.
 */
is_lifted: Array<boolean>, 
/**
 * Pull in the table's plane divided by the maximum friction, friction·(W − Fz): from 1 on the bead
 * follows. `None` if there is no friction, because the coefficient is zero or the bead lifts off.
 */
drag_ratio: Array<number | null>, 
/**
 * Offsets `(inner_m, outer_m)` between which the bead is dragged, of `force::capture_interval_m`.
 */
capture_m: [number, number] | null, };

/**
 * Query of `reach`.
 */
export type ReachQuery = { 
/**
 * Orientation of the block.
 */
orientation: Orientation, 
/**
 * Minimum height of its lower face above the table, m: at least the bead's diameter.
 */
lowest_m: number, 
/**
 * Maximum height, m.
 */
highest_m: number, 
/**
 * Direction of the bead from below the block's middle: from the block's x toward its y.
 */
direction_rad: number, 
/**
 * Coulomb's coefficient.
 */
friction: number, 
/**
 * Viscous drag on the bead, N·s/m; not zero, since without drag the speed is unlimited.
 */
drag_n_s_m: number, 
/**
 * Number of heights, evenly spaced.
 */
count: number, };

/**
 * Reach and speed of the drag over the block's height; every array has one entry per height.
 */
export type ReachCurve = { 
/**
 * Lower face above the table, m.
 */
lower_face_height_m: Array<number>, 
/**
 * Offsets `(inner_m, outer_m)` between which a bead is dragged, of `force::capture_interval_m`.
 */
capture_m: Array<[number, number] | null>, 
/**
 * Fz/W right below the block's middle.
 */
lift_ratio: Array<number>, 
/**
 * Maximum Fz/W over the offsets in the direction; 1 lifts the bead.
 */
greatest_lift_ratio: Array<number>, 
/**
 * Maximum speed, m/s, at which a sliding bead can follow at a fixed offset in the direction: there
 * the pull minus friction equals the drag. `None` if the pull never exceeds friction.
 */
largest_speed_m_s: Array<number | null>, 
/**
 * Height of the lower face, m, below which a bead right below the block's middle lifts off. In C the
 * lift is greatest beside the middle, where a bead lifts off a few tenths of a millimetre higher.
 */
lift_off_m: number, };

/**
 * Query of `plane`.
 */
export type PlaneQuery = { 
/**
 * Orientation of the block.
 */
orientation: Orientation, 
/**
 * Its lower face above the table, m: at least the bead's diameter.
 */
lower_face_height_m: number, 
/**
 * Half side of the square around the point below the block's middle, m, along the block's x and y.
 */
reach_m: number, 
/**
 * Number of points per row and column, evenly spaced, the first and last ones at the edges.
 */
count: number, };

/**
 * The field in a square around the block: one entry per point, row by row from the minimum x and y.
 */
export type Plane = { 
/**
 * |B|, T.
 */
field_t: Array<number>, 
/**
 * Pull on the bead in the table's plane, N.
 */
pull_n: Array<[number, number]>, };

/**
 * Body of `POST /api/kinematics/workspace`.
 */
export type WorkspaceQuery = { 
/**
 * Area for the tool point.
 */
area: Rect, 
/**
 * Side of a cell.
 */
cell_m: number, 
/**
 * Lower face of the block above the table.
 */
tool_height_m: number, 
/**
 * How the arm holds its flange.
 */
tool_orientation: ToolOrientation, };

/**
 * Answer of `POST /api/kinematics/workspace`.
 */
export type WorkspaceMap = { 
/**
 * Poses with less are refused as singular.
 */
least_m3: number, 
/**
 * Cells along x.
 */
columns: number, 
/**
 * Cells along y.
 */
rows: number, 
/**
 * Lower left corner of the lower left cell, `[x_m, y_m]`.
 */
origin_m: [number, number], 
/**
 * Side of a cell.
 */
cell_m: number, 
/**
 * |det J| in m³ with the flange over each cell's centre: `rows × columns` values, row by row from the
 * lower left. `None` if the branch does not reach the cell.
 */
manipulability_m3: Array<number | null>, };

/**
 * Body of `POST /api/sessions/{id}/flow`.
 */
export type FlowQuery = { 
/**
 * Distance between two places, .005 to .05 m.
 */
spacing_m: number, 
/**
 * Number of the page's last `seen` message. The server ignores it; it makes the request a new one
 * when more was observed.
 */
seen: number, };

/**
 * The attractor's flow for goal, parameters and obstacle map.
 */
export type FlowField = { 
/**
 * Places across.
 */
columns: number, 
/**
 * Places away from the user.
 */
rows: number, 
/**
 * The place with minimum x and y.
 */
origin_m: [number, number], 
/**
 * Distance between two places.
 */
spacing_m: number, 
/**
 * Velocities row by row from the minimum x and y; `null` over a known obstacle. Empty without a
 * goal.
 */
velocity_m_s: Array<[number, number] | null>, };
