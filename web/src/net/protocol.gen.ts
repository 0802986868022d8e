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
 * Outer ring, `[x_m, y_m]` per vertex.
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
 * Smallest x.
 */
x_min_m: number, 
/**
 * Largest x.
 */
x_max_m: number, 
/**
 * Smallest y.
 */
y_min_m: number, 
/**
 * Largest y.
 */
y_max_m: number, };

/**
 * Sub-controller 2, by name.
 */
export type ControllerName = "rl" | "errt" | "attractor";

/**
 * Which of the two.
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
 * For so long.
 */
for_s: number, } } | { "dropout": { 
/**
 * For so long.
 */
for_s: number, } };

/**
 * When a scripted disturbance strikes. Those that wait for the bead strike in the order of the script.
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
 * A disturbance and its time.
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
 * What carries the magnet; left out, what the map is made for.
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
 * Bead at the start, the tool above it; left out, a random free point.
 */
start_m: [number, number] | null, 
/**
 * Goal at the start; left out, none: the arm holds.
 */
goal_m: [number, number] | null, 
/**
 * How often the bead is lifted away at random during transport (specification §2).
 */
disturbances: number, 
/**
 * Disturbances at set times, [`SCRIPT_LIMIT`] at most.
 */
script: Array<Scripted>, };

/**
 * What a browser may send. Fields are named and measured as everywhere: metres in `base`.
 */
export type ClientMessage = { "type": "set_goal", x_m: number, y_m: number, } | { "type": "clear_goal", } | { "type": "drag", x_m: number, y_m: number, lift?: boolean, } | { "type": "release", } | { "type": "select_controller", controller: ControllerName, } | { "type": "configure", parameters: Parameters, } | { "type": "run", } | { "type": "pause", } | { "type": "step", ticks: number, } | { "type": "set_speed", factor: number, } | { "type": "reset", seed?: number, } | { "type": "load_scenario", map: string, controller?: ControllerName, positioner?: PositionerKind, seed?: number | string, start_m?: [number, number], goal_m?: [number, number], parameters?: Parameters, disturbances?: number, script?: Array<Scripted>, } | { "type": "disturb", disturbance: Disturbance, } | { "type": "rewind", tick: number, } | { "type": "fork", tick: number, controllers?: Array<ControllerName>, } | { "type": "take_control", } | { "type": "release_control", };

/**
 * Who this browser is.
 */
export type Role = "operator" | "viewer";

/**
 * What the server sends as text.
 */
export type ServerMessage = { "type": "hello" } & Hello | { "type": "scene" } & SceneMessage | { "type": "state" } & StateMessage | { "type": "event" } & EventMessage | { "type": "overlay" } & OverlayMessage | { "type": "seen" } & SeenMessage | { "type": "comparison" } & ComparisonMessage | { "type": "error" } & ErrorMessage;

/**
 * See [`ServerMessage::Hello`].
 */
export type Hello = { 
/**
 * [`PROTOCOL_VERSION`].
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
 * Number of the operator's lease; it rises when control passes on. A command may carry it as `epoch`, and is
 * refused when it is no longer that.
 */
epoch: number, 
/**
 * Whether anybody is the operator.
 */
operator_present: boolean, 
/**
 * Whether this browser is the operator and another one asks it to make way.
 */
asked: boolean, 
/**
 * Graphics adapter that renders the camera.
 */
adapter: string, };

/**
 * See [`ServerMessage::Scene`].
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
 * How the trial was set up; controller, goal and parameters may have changed since.
 */
scenario: Scenario, 
/**
 * What carries the magnet in this trial.
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
 * Seed in force.
 */
seed: number, 
/**
 * Parameters in force.
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
 * Corners of the part of the table that the camera sees, from the tool.
 */
camera_sees_m: Array<[number, number]>, 
/**
 * Number of the trial: another one when a trial was set up anew.
 */
trial: number, 
/**
 * Distances from the tool at which the magnet's pull beats friction, nearest and farthest, for the
 * parameters in force, in 72 directions from +x counter-clockwise; none where it never does, and no
 * farthest where it always does.
 */
capture_m: Array<[number, number | null] | null>, 
/**
 * Seconds a tick.
 */
tick_s: number, };

/**
 * See [`ServerMessage::State`].
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
 * Whether time runs.
 */
running: boolean, 
/**
 * Asked simulated seconds a second.
 */
speed_target: number, 
/**
 * Achieved simulated seconds a second.
 */
speed_achieved: number, 
/**
 * How late the latest tick of the last half second came, in milliseconds of the clock.
 */
lateness_ms: number, 
/**
 * How often the session fell so far behind that lost time was let go, since it began.
 */
missed_deadlines: number, 
/**
 * Tool point: the middle of the block's lower face.
 */
tool_m: [number, number, number], 
/**
 * Centre of the bead, the truth.
 */
bead_m: [number, number, number], 
/**
 * The bead as the optical tracker gives it.
 */
bead_tracked_m: [number, number], 
/**
 * Goal, if one is set.
 */
goal_m: [number, number, number] | null, 
/**
 * Where the hand wants the bead, while it holds it.
 */
hand_m: [number, number] | null, 
/**
 * Force of the hand's spring on the bead (0 when not held).
 */
hand_force_n: number, 
/**
 * Joint angles; none on the planar stage, which has no arm.
 */
joints_rad: [number, number, number, number, number, number] | null, 
/**
 * Active sub-controller, 1 or 2.
 */
mode: number, 
/**
 * Why it is active, one plain sentence.
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
 * What the arm does in words: `holding`, `approaching`, `transporting`, `settling`, `delivered`, `lifted off`, `stopped`.
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
 * Its norm: the `e` of the switching law.
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
 * Vertical pull in units of the bead's weight; 1 is lift-off.
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
 * `recording`, or why this session is not recorded.
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
 * See [`ServerMessage::Event`].
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
 * One plain sentence.
 */
text: string, };

/**
 * An obstacle as the attractor sees it: a superellipse of exponent 4.
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
 * See [`ServerMessage::Overlay`].
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
 * Takes (x, y, 1) on the table, in metres, to (column, row, 1) times a factor in the camera's picture.
 */
picture_from_table: [[number, number, number], [number, number, number], [number, number, number]], 
/**
 * What the image is made of.
 */
blocks: BlocksLayer, 
/**
 * What ERRT plans, while it is sub-controller 2.
 */
plan: PlanLayer | null, 
/**
 * What the policy thinks, while it is sub-controller 2.
 */
judgement: JudgementLayer | null, };

/**
 * The camera's image as the planner takes it, seen from straight above.
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
 * ERRT's last search, and the way that is followed.
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
 * Distance that the way keeps from walls away from its ends.
 */
clearance_m: number | null, 
/**
 * Ways planned since the trial began.
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
 * Obstacles that it plans around, as few rectangles as possible.
 */
obstacles: Array<Rect>, };

/**
 * What the camera has shown of the workspace since the trial began.
 */
export type SeenMessage = { 
/**
 * Raised with each of the session's.
 */
number: number, 
/**
 * What the grid covers.
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
 * Equal cells in succession, from the least x and y row by row, which may go on in the next row: 0 for
 * unknown, 1 for free, 2 for an obstacle; and how many.
 */
runs: Array<[number, number]>, };

/**
 * What one controller makes of the moment.
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
 * What the arm did last, as in the state.
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
 * Largest difference in x during transport.
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
 * A moment run on under several controllers, each from the same state with the same disturbances.
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
 * The same in seconds.
 */
sim_time_s: number, 
/**
 * Tick at which branches end at the latest.
 */
until_tick: number, 
/**
 * Sub-controller 2 at that moment: its branch is what happens without a change.
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
 * Why it came to a halt, if it did.
 */
failed: string | null, 
/**
 * One a controller, in the order asked for; those not begun yet are left out.
 */
branches: Array<Branch>, };

/**
 * Answer of `GET /api/sessions/{id}/moments/{tick}`: the control step at or before a tick, lived through again.
 */
export type MomentMessage = { 
/**
 * Tick of the control step.
 */
tick: number, 
/**
 * The same in seconds.
 */
sim_time_s: number, 
/**
 * Active sub-controller from then on, 1 or 2.
 */
mode: number, 
/**
 * Whether it was the other one before.
 */
switched: boolean, 
/**
 * Why, one plain sentence.
 */
reason: string, 
/**
 * e: distance from tool to tracked bead in the plane.
 */
error_m: number, 
/**
 * What e was held against: T, or the fetch radius during a fetch.
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
 * Bead, the truth.
 */
bead_m: [number, number], 
/**
 * Bead as tracked.
 */
bead_tracked_m: [number, number], 
/**
 * Goal, if there is one.
 */
goal_m: [number, number] | null, 
/**
 * Next tool target, if it goes to one.
 */
target_m: [number, number] | null, 
/**
 * Why the arm holds, if a step was refused.
 */
refusal: string | null, 
/**
 * What the controller saw and made of it.
 */
overlay: OverlayMessage, };

/**
 * See [`ServerMessage::Error`]; the same fields stand in an HTTP problem.
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
 * The field at fault.
 */
field?: string, };

/**
 * What [`pull`] is drawn for.
 */
export type PullQuery = { 
/**
 * How the block hangs.
 */
orientation: Orientation, 
/**
 * Its lower face above the table, m: at least the bead's diameter.
 */
lower_face_height_m: number, 
/**
 * Where the bead lies, from below the block's middle: along the block's x, turned toward its y.
 */
direction_rad: number, 
/**
 * Coulomb's coefficient.
 */
friction: number, 
/**
 * The greatest offset, m.
 */
farthest_m: number, 
/**
 * Number of offsets, from zero on, evenly spaced.
 */
count: number, };

/**
 * The pull on a bead over its horizontal offset: an entry an offset in every array.
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
 * (W − Fz)/W: what remains of the weight.
 */
weight_ratio: Array<number>, 
/**
 * Whether the bead lifts off: nothing remains of its weight.
 */
is_lifted: Array<boolean>, 
/**
 * Pull in the table's plane over what friction can hold, friction·(W − Fz): from 1 on the bead
 * follows. `None` where friction holds nothing, because it is zero or the bead lifts off.
 */
drag_ratio: Array<number | null>, 
/**
 * Offsets `(inner_m, outer_m)` between which the bead is dragged, of [`force::capture_interval_m`].
 */
capture_m: [number, number] | null, };

/**
 * What [`reach`] is drawn for.
 */
export type ReachQuery = { 
/**
 * How the block hangs.
 */
orientation: Orientation, 
/**
 * Least height of its lower face above the table, m: at least the bead's diameter.
 */
lowest_m: number, 
/**
 * Greatest such height, m.
 */
highest_m: number, 
/**
 * Where the bead lies, from below the block's middle: along the block's x, turned toward its y.
 */
direction_rad: number, 
/**
 * Coulomb's coefficient.
 */
friction: number, 
/**
 * Viscous drag on the bead, N·s/m: not zero, else no speed is too large.
 */
drag_n_s_m: number, 
/**
 * Number of heights, evenly spaced.
 */
count: number, };

/**
 * How far and how fast the block drags a bead, over its height: an entry a height in every array.
 */
export type ReachCurve = { 
/**
 * Lower face above the table, m.
 */
lower_face_height_m: Array<number>, 
/**
 * Offsets `(inner_m, outer_m)` between which a bead is dragged, of [`force::capture_interval_m`].
 */
capture_m: Array<[number, number] | null>, 
/**
 * Fz/W right below the block's middle.
 */
lift_ratio: Array<number>, 
/**
 * The greatest Fz/W of any offset in the direction; 1 lifts the bead.
 */
greatest_lift_ratio: Array<number>, 
/**
 * The greatest speed, m/s, at which a sliding bead can follow at a fixed offset in the direction: there
 * the pull less friction equals the drag. `None` where no pull exceeds friction.
 */
largest_speed_m_s: Array<number | null>, 
/**
 * Height of the lower face, m, below which a bead right below the block's middle lifts off. In C the
 * lift is greatest beside the middle, and a bead there lifts off from some tenths of a millimetre higher.
 */
lift_off_m: number, };

/**
 * What [`plane`] is computed for.
 */
export type PlaneQuery = { 
/**
 * How the block hangs.
 */
orientation: Orientation, 
/**
 * Its lower face above the table, m: at least the bead's diameter.
 */
lower_face_height_m: number, 
/**
 * How far the square reaches from below the block's middle, m, along the block's x and y.
 */
reach_m: number, 
/**
 * Places of a row and of a column, evenly spaced, the first and the last at the edges.
 */
count: number, };

/**
 * The field in a square around the block: an entry a place, row by row from the least x and y.
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
 * What the policy made of the last image that it judged.
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
 * The goal to judge for.
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
 * What the session's policy thinks of every place of the map on the way to a goal, by the default camera's images.
 * Places are a centimetre apart, farther where there would be more than 4000.
 */
export type ValueMap = { 
/**
 * Side of a cell.
 */
spacing_m: number, 
/**
 * Cells that keep the policy's distance from the walls.
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
 * Of the session's `seen` messages the one that the page has. Not looked at: it makes the question a new one
 * when more was seen.
 */
seen: number, };

/**
 * Where attractor dynamics lead from each place of the workspace, for goal, parameters and what was seen up to now.
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
 * The place of least x and y.
 */
origin_m: [number, number], 
/**
 * Distance between two places.
 */
spacing_m: number, 
/**
 * Velocities row by row from the least y, each row from the least x; none over a known obstacle. Empty without a
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
 * Scripted disturbances a trial, 0 to 10.
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
 * What one row of the table is about.
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
 * Scripted disturbances a trial.
 */
disturbances: number, };

/**
 * How an evaluation stands.
 */
export type EvaluationStage = "waiting" | "running" | "done" | "cancelled" | "failed";

/**
 * The paper's numbers for a row.
 */
export type PaperRow = { 
/**
 * Where they stand.
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
 * A cell of an evaluation, and how far it is.
 */
export type EvaluationCell = { 
/**
 * Trials that ended.
 */
done: number, 
/**
 * Of these, trials whose bead arrived.
 */
delivered: number, 
/**
 * How long it ran, to the last trial that ended.
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
 * Scripted disturbances a trial.
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
 * What was asked.
 */
query: EvaluationQuery, 
/**
 * How it stands.
 */
stage: EvaluationStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * What it comes to, in the order in which it runs.
 */
cells: Array<EvaluationCell>, 
/**
 * How many of the cells have their row.
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
 * Scripted disturbances a trial.
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
 * Mean over trials of the mean difference in x during transport, without its sign.
 */
tracking_error_mean_x_m: number, 
/**
 * The same in y.
 */
tracking_error_mean_y_m: number, 
/**
 * Mean over trials of the largest difference in x during transport.
 */
tracking_error_max_x_m: number, 
/**
 * The same in y.
 */
tracking_error_max_y_m: number, 
/**
 * Mean over trials that delivered of the tool's way over the shortest; none if none did.
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
 * Disturbances that struck, all trials together.
 */
disturbances_struck: number, 
/**
 * Median milliseconds a control step, camera included.
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
 * The first controller against the second, trial by trial: the same start, goal, seed and pushes.
 */
export type Comparison = { 
/**
 * Map.
 */
map: string, 
/**
 * Scripted disturbances a trial.
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
 * Trials that both delivered.
 */
both: number, 
/**
 * That the first alone delivered.
 */
first_only: number, 
/**
 * That the second alone delivered.
 */
second_only: number, 
/**
 * That neither delivered.
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
 * The same of the mean distance of tool and bead during transport.
 */
tracking_error_mean_m: PairedMean | null, 
/**
 * The same of the way over the shortest.
 */
path_ratio: PairedMean | null, };

/**
 * A trial whose bead did not arrive. With map, controller and disturbances of its cell, seed, start and goal set it
 * up again.
 */
export type EvaluationFailure = { 
/**
 * Its cell, from 0.
 */
cell: number, 
/**
 * Which trial of the evaluation's seed.
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
 * What kept sub-controller 2 from the goal, if anything did.
 */
trouble: string | null, 
/**
 * Why the arm held in the end, if it did.
 */
refusal: string | null, 
/**
 * Control steps.
 */
steps: number, 
/**
 * Disturbances that struck.
 */
disturbances: number, };

/**
 * Answer of `GET /api/evaluations/{id}`.
 */
export type EvaluationReport = { 
/**
 * Rows of the cells that are through, in the order of the cells; those of `ferry evaluate --json`.
 */
rows: Array<Row>, 
/**
 * Every two controllers of the same map and disturbances among them.
 */
comparisons: Array<Comparison>, 
/**
 * Their trials whose bead did not arrive.
 */
failures: Array<EvaluationFailure>, 
/**
 * Its name.
 */
id: string, 
/**
 * What was asked.
 */
query: EvaluationQuery, 
/**
 * How it stands.
 */
stage: EvaluationStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, 
/**
 * What it comes to, in the order in which it runs.
 */
cells: Array<EvaluationCell>, 
/**
 * How many of the cells have their row.
 */
rows_done: number, };

/**
 * Answer of `GET /api/evaluations`.
 */
export type Evaluations = { 
/**
 * In the order in which they were asked for.
 */
evaluations: Array<EvaluationSummary>, };
