// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Parameters } from '../parameters.gen';

/**
 * A filled polygon with holes, in metres.
 *
 * `exterior` runs counter-clockwise and each hole clockwise; no ring repeats its first point.
 */
export type Polygon = { 
/**
 * Outer ring, `[x_m, y_m]` for each vertex.
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
export type ControllerName = "rl" | "errt" | "attractor" | "replanner" | "you" | "program" | "robot";

/**
 * The kind of positioner.
 */
export type PositionerKind = "arm" | "planar_stage";

export type Disturbance = { "displace": { x_m: number, y_m: number, } } | { "impulse": { x_n_s: number, y_n_s: number, } } | { "drift": { x_n: number, y_n: number, for_s: number, } } | { "dropout": { for_s: number, } };

/**
 * When a scripted disturbance is applied. Those that wait for the bead are applied in the order of the script.
 */
export type When = { "tick": number } | { "step": number } | { "passes_x_m": number } | { "near": { x_m: number, y_m: number, 
/**
 * 1 mm to 1 m.
 */
within_m: number, } };

/**
 * A disturbance with its time.
 */
export type Scripted = { at: When, disturbance: Disturbance, };

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
