// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Rect } from './experiment.gen';

/**
 * An obstacle as sensed for the attractor: a superellipse of exponent 4.
 */
export type SensedObstacle = { 
/**
 * Centre.
 */
center_m: [number, number], 
/**
 * Half sides of the fitted rectangle.
 */
half_size_m: [number, number], 
/**
 * Half sides of the superellipse with its safety margin.
 */
boundary_m: [number, number], };

/**
 * See `ServerMessage::Overlay`.
 */
export type OverlayMessage = { 
/**
 * When the camera frame was taken.
 */
tick: number, 
/**
 * Obstacles sensed in it.
 */
obstacles: Array<SensedObstacle>, 
/**
 * Mean of the 15×15 pixels around the tool, 0 to 255.
 */
center_mean: number, 
/**
 * Those pixels, on the table.
 */
patch: Rect, 
/**
 * Obstacle test: `center_mean` < 150.
 */
obstacle: boolean, 
/**
 * Next tool target.
 */
target_m: [number, number] | null, 
/**
 * Homography from (x, y, 1) on the table, in metres, to (column, row, 1) times a factor in the camera's image.
 */
picture_from_table: [[number, number, number], [number, number, number], [number, number, number]], 
/**
 * Blocks of the image.
 */
blocks: BlocksLayer, 
/**
 * ERRT's plan, while it is sub-controller 2.
 */
plan: PlanLayer | null, 
/**
 * The policy's quantiles, while it is sub-controller 2.
 */
judgement: JudgementLayer | null, };

/**
 * The camera's image as used by the planner, from straight above.
 */
export type BlocksLayer = { 
/**
 * Upper left corner on the table.
 */
origin_m: [number, number], 
/**
 * Side of a pixel on the table.
 */
pixel_m: number, 
/**
 * Dark blocks of the quadtree.
 */
dark: Array<[number, number, number, number]>, 
/**
 * Free blocks of the quadtree.
 */
free: Array<[number, number, number, number]>, 
/**
 * The dark blocks merged into as few rectangles as possible.
 */
rectangles: Array<[number, number, number, number]>, };

/**
 * ERRT's last search and the path that is followed.
 */
export type PlanLayer = { 
/**
 * Both ends of every edge, x, y, x, y in metres; 4000 at most.
 */
tree: Array<[number, number, number, number]>, 
/**
 * Corners of the path, including start and goal; empty without a path.
 */
way: Array<[number, number]>, 
/**
 * Distance of the path from walls, except near its ends.
 */
clearance_m: number | null, 
/**
 * Paths planned since the start of the trial.
 */
plans: number, 
/**
 * Edges tried in the last search.
 */
attempts: number, 
/**
 * Weight of the cost from the root in the choice of the nearest node.
 */
beta: number, 
/**
 * Obstacles for planning, as the fewest rectangles.
 */
obstacles: Array<Rect>, };

/**
 * The obstacle map observed since the start of the trial.
 */
export type SeenMessage = { 
/**
 * Number of the message, increasing within the session.
 */
number: number, 
/**
 * The area of the grid.
 */
workspace: Rect, 
/**
 * Cells along x.
 */
columns: number, 
/**
 * Cells along y.
 */
rows: number, 
/**
 * Runs of equal cells with their length, row by row from the minimum x and y; a run may continue in the next row:
 * 0 for unknown, 1 for free, 2 for an obstacle.
 */
runs: Array<[number, number]>, };

/**
 * The policy's evaluation of the last image.
 */
export type JudgementLayer = { 
/**
 * The policy that acts: `colon`, `general` or `explorer`, or `own` for one from a file.
 */
policy: string, 
/**
 * Quantiles of the return for +x, −x, +y and −y, at the fractions (k + ½) / K.
 */
quantiles: [Array<number>, Array<number>, Array<number>, Array<number>], 
/**
 * Mean return of each action.
 */
values: [number, number, number, number], 
/**
 * Index of the action that was taken; the best one, unless the shield chose the next best.
 */
taken: number, 
/**
 * Whether the tool goes straight over several cells of the route that begins with the action.
 */
is_shortcut: boolean, 
/**
 * Maps that the policy was trained on.
 */
trained_on: Array<string>, 
/**
 * Whether the policy remembers what the camera has seen, so that it needs no training on the map.
 */
has_memory: boolean, };
