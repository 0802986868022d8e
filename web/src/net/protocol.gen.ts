// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Orientation, Parameters, ToolOrientation } from './parameters.gen';
export type { Orientation, Parameters, ToolOrientation };

export const PROTOCOL_VERSION = 6;
export const BINARY_CAMERA_JPEG = 1;
export const BINARY_OBSERVATION = 2;

/** A control step is due at the first tick at or after each. */
export const CONTROL_PERIOD_S = 0.25;

/** Fastest that time runs. */
export const SPEED_MAX = 64;

/** A goal is reached within it. */
export const GOAL_RADIUS_M = 0.02;

/** Darker places are obstacles. */
export const OBSTACLE_MEAN = 150;

/** Entries of a script. */
export const SCRIPT_LIMIT = 64;

/** Last control step that a script may wait for. */
export const MOST_STEPS = 600;

/** Strongest kick. */
export const MOST_IMPULSE_N_S = 0.002;

/** Strongest push. */
export const MOST_DRIFT_N = 0.01;

/** Longest push, and longest blindness of the tracker. */
export const MOST_SECONDS = 60;

/** Edges of a tree that are sent. */
export const MOST_EDGES = 4000;

/** Least spacing of a flow field. */
export const LEAST_FLOW_SPACING_M = 0.005;

/** Greatest spacing of a flow field. */
export const MOST_FLOW_SPACING_M = 0.05;

/** A capture that ends here ends nowhere. */
export const FARTHEST_CAPTURE_M = 0.5;

/** Height of the walls. */
export const WALL_HEIGHT_M = 0.005;

/** Columns and rows of the camera image. */
export const CAMERA_PX = 480;

/** Columns and rows of the observation. */
export const OBSERVATION_PX = 84;

/** Largest drawing of a map. */
export const MAX_SVG_BYTES = 1048576;


/**
 * A filled polygon with holes, in metres.
 *
 * `exterior` runs counter-clockwise and each hole clockwise; no ring repeats its first point.
 */
export type Polygon = { 
/**
 * Outer ring, `[x_m, y_m]` a vertex.
 */
exterior: Array<[number, number]>, 
/**
 * Inner rings.
 */
holes: Array<Array<[number, number]>>, };

/**
 * An axis-aligned rectangle, in metres.
 */
export type Rect = { 
/**
 * Least x.
 */
x_min_m: number, 
/**
 * Greatest x.
 */
x_max_m: number, 
/**
 * Least y.
 */
y_min_m: number, 
/**
 * Greatest y.
 */
y_max_m: number, };

/**
 * Sub-controller 2, by name.
 */
export type ControllerName = "rl" | "errt" | "attractor";

/**
 * The kind of positioner.
 */
export type PositionerKind = "arm" | "planar_stage";

/**
 * One disturbance.
 */
export type Disturbance = { "displace": { 
/**
 * x.
 */
x_m: number, 
/**
 * y.
 */
y_m: number, } } | { "impulse": { 
/**
 * Along x.
 */
x_n_s: number, 
/**
 * Along y.
 */
y_n_s: number, } } | { "drift": { 
/**
 * Along x.
 */
x_n: number, 
/**
 * Along y.
 */
y_n: number, 
/**
 * Duration.
 */
for_s: number, } } | { "dropout": { 
/**
 * Duration.
 */
for_s: number, } };

/**
 * When a scripted disturbance is applied. Those that wait for the bead are applied in the order of the script.
 */
export type When = { "tick": number } | { "step": number } | { "passes_x_m": number } | { "near": { 
/**
 * x.
 */
x_m: number, 
/**
 * y.
 */
y_m: number, 
/**
 * 1 mm to 1 m.
 */
within_m: number, } };

/**
 * A disturbance with its time.
 */
export type Scripted = { 
/**
 * When.
 */
at: When, 
/**
 * What.
 */
disturbance: Disturbance, };

/**
 * A trial before its first tick.
 */
export type Scenario = { 
/**
 * Name of the map, or path of an SVG.
 */
map: string, 
/**
 * Sub-controller 2.
 */
controller: ControllerName, 
/**
 * The positioner; if omitted, the one that the map is made for.
 */
positioner: PositionerKind | null, 
/**
 * Seed of everything random in the trial.
 */
seed: number, 
/**
 * Parameters at the start.
 */
parameters: Parameters, 
/**
 * Bead at the start, with the tool above it; if omitted, a random free point.
 */
start_m: [number, number] | null, 
/**
 * Goal at the start; if omitted, the arm holds.
 */
goal_m: [number, number] | null, 
/**
 * Number of random displacements of the bead during transport.
 */
disturbances: number, 
/**
 * Scripted disturbances, at most [`SCRIPT_LIMIT`].
 */
script: Array<Scripted>, };

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
 * Number of the operator's lease; it increases when control passes on. A command may carry it as `epoch`, and is
 * refused if it is not the current one.
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
 * Maps that `load_scenario` knows.
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
 * Controllers that `select_controller` knows.
 */
controllers: Array<ControllerName>, 
/**
 * The workspace.
 */
workspace: Rect, 
/**
 * Walls inside the workspace, 5 mm high.
 */
walls: Array<Polygon>, 
/**
 * Current seed.
 */
seed: number, 
/**
 * Current parameters.
 */
parameters: Parameters, 
/**
 * Their defaults.
 */
defaults: Parameters, 
/**
 * Radius of the bead.
 */
bead_radius_m: number, 
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
export type EventMessage = { 
/**
 * When.
 */
tick: number, 
/**
 * When, in seconds.
 */
sim_time_s: number, 
/**
 * What.
 */
kind: EventKind, 
/**
 * One sentence.
 */
text: string, };

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
 * Runs of equal cells with their length, row by row from the minimum x and y; a run may continue in the next row: 0 for
 * unknown, 1 for free, 2 for an obstacle.
 */
runs: Array<[number, number]>, };

/**
 * One controller's run in a comparison.
 */
export type Branch = { 
/**
 * The controller.
 */
controller: ControllerName, 
/**
 * Tool x, y and bead x, y in metres, from the first sample after the moment.
 */
samples: Array<[number, number, number, number]>, 
/**
 * Whether it has ended.
 */
done: boolean, 
/**
 * Last phase, as in the state.
 */
phase: string, 
/**
 * Tick of the first delivery after the moment.
 */
delivered_tick: number | null, 
/**
 * Mean distance of tool and bead during transport.
 */
tracking_error_mean_m: number, 
/**
 * Maximum difference in x during transport.
 */
tracking_error_max_x_m: number, 
/**
 * The same in y.
 */
tracking_error_max_y_m: number, 
/**
 * Control steps since the moment.
 */
steps: number, 
/**
 * Switches since the moment.
 */
switches: number, };

/**
 * A comparison: one moment continued under several controllers, from the same state with the same disturbances.
 */
export type ComparisonMessage = { 
/**
 * Number of the trial, as in the scene.
 */
trial: number, 
/**
 * Tick of the moment.
 */
tick: number, 
/**
 * The tick in seconds.
 */
sim_time_s: number, 
/**
 * Tick at which branches end at the latest.
 */
until_tick: number, 
/**
 * Sub-controller 2 at that moment; its branch repeats the session.
 */
controller: ControllerName, 
/**
 * Ticks between two samples.
 */
ticks_a_sample: number, 
/**
 * Whether branches still run.
 */
running: boolean, 
/**
 * Why it failed, if it did.
 */
failed: string | null, 
/**
 * One branch per controller, in the requested order; branches that have not started are omitted.
 */
branches: Array<Branch>, };

/**
 * Answer of `GET /api/sessions/{id}/moments/{tick}`: the repeated control step at or before a tick.
 */
export type MomentMessage = { 
/**
 * Tick of the control step.
 */
tick: number, 
/**
 * The tick in seconds.
 */
sim_time_s: number, 
/**
 * Active sub-controller after the step, 1 or 2.
 */
mode: number, 
/**
 * Whether the step switched the sub-controller.
 */
switched: boolean, 
/**
 * Why, in one sentence.
 */
reason: string, 
/**
 * e: distance from tool to tracked bead in the plane.
 */
error_m: number, 
/**
 * The limit for e: T, or the fetch radius during a fetch.
 */
threshold_m: number, 
/**
 * Sub-controller 2 in use.
 */
controller: ControllerName, 
/**
 * What the arm does, as in the state.
 */
phase: string, 
/**
 * Tool point.
 */
tool_m: [number, number], 
/**
 * True position of the bead.
 */
bead_m: [number, number], 
/**
 * Position of the bead from the tracker.
 */
bead_tracked_m: [number, number], 
/**
 * Goal, if set.
 */
goal_m: [number, number] | null, 
/**
 * Next tool target, if any.
 */
target_m: [number, number] | null, 
/**
 * Why the arm holds, if a step was refused.
 */
refusal: string | null, 
/**
 * The controller's observation and layers.
 */
overlay: OverlayMessage, };

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
message: string, 
/**
 * The invalid field.
 */
field?: string, };

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
 * Where the tool point goes.
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
 * |det J| in m³ with the flange over each cell's centre, row by row from the lower left; `None`
 * where the branch does not reach. `rows × columns` values.
 */
manipulability_m3: Array<number | null>, };

/**
 * The policy's evaluation of the last image.
 */
export type JudgementLayer = { 
/**
 * Quantiles of the return for +x, −x, +y and −y, at the fractions (k + ½) / K.
 */
quantiles: [Array<number>, Array<number>, Array<number>, Array<number>], 
/**
 * Their means.
 */
values: [number, number, number, number], 
/**
 * Index of the action that was taken; the best one, unless the shield chose the next best.
 */
taken: number, 
/**
 * Maps that the policy was trained on.
 */
trained_on: Array<string>, };

/**
 * Body of `POST /api/sessions/{id}/values`.
 */
export type ValueQuery = { 
/**
 * The goal.
 */
goal_m: [number, number], };

/**
 * One cell of a [`ValueMap`].
 */
export type ValueCell = { 
/**
 * Its middle.
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
 * Values of the session's policy for every place of the map and one goal, from images of the default camera.
 * Places are a centimetre apart, farther where there would be more than 4000.
 */
export type ValueMap = { 
/**
 * Side of a cell.
 */
spacing_m: number, 
/**
 * Cells with at least the policy's clearance from walls.
 */
cells: Array<ValueCell>, 
/**
 * Maps that the policy was trained on.
 */
trained_on: Array<string>, };

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

/**
 * A part of a session's recording on disk; `GET /api/recordings/{id}.rrd` is Rerun's file, `{id}.ferry` its input
 * log.
 */
export type RecordingFile = { 
/**
 * Name of the files without their endings.
 */
id: string, 
/**
 * The session that it is of; none where the file was not named by Ferry.
 */
session: string | null, 
/**
 * When it began, RFC 3339; none where the file was not named by Ferry.
 */
started: string | null, 
/**
 * Size of Rerun's file up to now.
 */
bytes: number, 
/**
 * Size of its input log, if it has one.
 */
log_bytes: number | null, 
/**
 * Whether it is being written: it grows, and has no footer yet.
 */
live: boolean, };

/**
 * Answer of `GET /api/recordings`.
 */
export type RecordingList = { 
/**
 * The newest first.
 */
recordings: Array<RecordingFile>, };

/**
 * Body of `POST /api/evaluations`: every controller on every map with every number of disturbances, each on the
 * same starts, goals and seeds.
 */
export type EvaluationQuery = { 
/**
 * Sub-controllers 2.
 */
controllers: Array<ControllerName>, 
/**
 * Names of maps, shipped or added.
 */
maps: Array<string>, 
/**
 * Scripted disturbances per trial, 0 to 10.
 */
disturbances: Array<number>, 
/**
 * Trials a cell, 1 to 1000.
 */
episodes: number, 
/**
 * Seed of the trials.
 */
seed: number, };

/**
 * The subject of one row of the table.
 */
export type Cell = { 
/**
 * Sub-controller 2.
 */
controller: ControllerName, 
/**
 * Map.
 */
map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, };

/**
 * Stage of an evaluation.
 */
export type EvaluationStage = "waiting" | "running" | "done" | "cancelled" | "failed";

/**
 * The paper's numbers for a row.
 */
export type PaperRow = { 
/**
 * Source in the paper.
 */
section: string, 
/**
 * Trials.
 */
episodes: number, 
/**
 * Trials whose tool reached the goal.
 */
successes: number, 
/**
 * Wilson 95 % interval of `successes / episodes`.
 */
successes_wilson95: [number, number], 
/**
 * As printed.
 */
printed: string, 
/**
 * Mean tracking error in both axes.
 */
tracking_error_mean_m: number | null, 
/**
 * Mean over trials of the largest in x.
 */
tracking_error_max_x_m: number | null, 
/**
 * The same in y.
 */
tracking_error_max_y_m: number | null, };

/**
 * A cell of an evaluation with its progress.
 */
export type EvaluationCell = { 
/**
 * Number of trials that ended.
 */
done: number, 
/**
 * Number of these that delivered.
 */
delivered: number, 
/**
 * Time until the last trial ended.
 */
elapsed_s: number, 
/**
 * The paper's numbers for it, if it has any.
 */
paper: PaperRow | null, 
/**
 * Sub-controller 2.
 */
controller: ControllerName, 
/**
 * Map.
 */
map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, };

/**
 * An evaluation without its rows.
 */
export type EvaluationSummary = { 
/**
 * Its name.
 */
id: string, 
/**
 * The query.
 */
query: EvaluationQuery, 
/**
 * Its stage.
 */
stage: EvaluationStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * Its cells, in the order in which they run.
 */
cells: Array<EvaluationCell>, 
/**
 * Number of complete cells.
 */
rows_done: number, };

/**
 * One row of the table.
 */
export type Row = { 
/**
 * Sub-controller 2.
 */
controller: string, 
/**
 * Map.
 */
map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, 
/**
 * Trials.
 */
episodes: number, 
/**
 * Trials whose tool reached the goal (paper's test).
 */
successes: number, 
/**
 * Wilson 95 % interval of `successes / episodes`.
 */
successes_wilson95: [number, number], 
/**
 * Trials whose bead reached the goal.
 */
delivered: number, 
/**
 * Wilson 95 % interval of `delivered / episodes`.
 */
wilson95: [number, number], 
/**
 * Mean over trials of the mean distance of tool and bead during transport.
 */
tracking_error_mean_m: number, 
/**
 * Mean over trials of the mean absolute difference in x during transport.
 */
tracking_error_mean_x_m: number, 
/**
 * The same in y.
 */
tracking_error_mean_y_m: number, 
/**
 * Mean over trials of the maximum difference in x during transport.
 */
tracking_error_max_x_m: number, 
/**
 * The same in y.
 */
tracking_error_max_y_m: number, 
/**
 * Mean over delivered trials of the tool's path divided by the shortest path; missing without a delivery.
 */
path_ratio_mean: number | null, 
/**
 * Mean control steps.
 */
steps_mean: number, 
/**
 * Mean switches.
 */
switches_mean: number, 
/**
 * Disturbances applied in all trials together.
 */
disturbances_struck: number, 
/**
 * Median duration of a control step in milliseconds, including the camera.
 */
decision_ms_p50: number, 
/**
 * 99th percentile.
 */
decision_ms_p99: number, };

/**
 * A mean difference.
 */
export type PairedMean = { 
/**
 * Mean.
 */
mean: number, 
/**
 * Its 95 % interval (Student's t).
 */
interval95: [number, number], };

/**
 * Two controllers compared trial by trial, with the same starts, goals, seeds and disturbances.
 */
export type Comparison = { 
/**
 * Map.
 */
map: string, 
/**
 * Scripted disturbances per trial.
 */
disturbances: number, 
/**
 * The first.
 */
controller: string, 
/**
 * The second.
 */
against: string, 
/**
 * Trials.
 */
episodes: number, 
/**
 * Trials delivered by both.
 */
both: number, 
/**
 * Trials delivered by the first only.
 */
first_only: number, 
/**
 * Trials delivered by the second only.
 */
second_only: number, 
/**
 * Trials delivered by neither.
 */
neither: number, 
/**
 * Share delivered by the first minus that by the second.
 */
delivered_difference: number, 
/**
 * Its 95 % interval (Newcombe 1998, method 10).
 */
delivered_difference95: [number, number], 
/**
 * Control steps of the first minus those of the second, where both delivered.
 */
steps: PairedMean | null, 
/**
 * The same for the mean distance of tool and bead during transport.
 */
tracking_error_mean_m: PairedMean | null, 
/**
 * The same for path ÷ shortest path.
 */
path_ratio: PairedMean | null, };

/**
 * A trial that did not deliver. Its seed, start and goal, with map, controller and disturbances of its cell, set it
 * up again.
 */
export type EvaluationFailure = { 
/**
 * Its cell, from 0.
 */
cell: number, 
/**
 * Index of the trial.
 */
index: number, 
/**
 * Seed of the trial itself, as text.
 */
seed: string, 
/**
 * Bead and tool at the start.
 */
start_m: [number, number] | null, 
/**
 * Goal.
 */
goal_m: [number, number] | null, 
/**
 * Whether the tool came to the goal.
 */
reached: boolean, 
/**
 * How it ended.
 */
outcome: string, 
/**
 * What kept sub-controller 2 from the goal, if anything.
 */
trouble: string | null, 
/**
 * Why the arm held at the end, if it did.
 */
refusal: string | null, 
/**
 * Control steps.
 */
steps: number, 
/**
 * Disturbances applied.
 */
disturbances: number, };

/**
 * Answer of `GET /api/evaluations/{id}`.
 */
export type EvaluationReport = { 
/**
 * Rows of the complete cells, in their order, as in `ferry evaluate --json`.
 */
rows: Array<Row>, 
/**
 * Every pair of controllers on the same map with the same disturbances.
 */
comparisons: Array<Comparison>, 
/**
 * Trials that did not deliver.
 */
failures: Array<EvaluationFailure>, 
/**
 * Its name.
 */
id: string, 
/**
 * The query.
 */
query: EvaluationQuery, 
/**
 * Its stage.
 */
stage: EvaluationStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * Its cells, in the order in which they run.
 */
cells: Array<EvaluationCell>, 
/**
 * Number of complete cells.
 */
rows_done: number, };

/**
 * Answer of `GET /api/evaluations`.
 */
export type Evaluations = { 
/**
 * In the order of submission.
 */
evaluations: Array<EvaluationSummary>, };
