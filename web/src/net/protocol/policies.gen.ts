// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { Examination, TrainingPoint, TrainingQuery } from './trainings.gen';

/**
 * How a policy was trained on this server.
 */
export type PolicyOrigin = { query: TrainingQuery, 
/**
 * The last examination.
 */
examined: Examination, 
/**
 * Time spent on the training.
 */
elapsed_s: number, 
/**
 * At most 50 points.
 */
curve: Array<TrainingPoint>, };

/**
 * A policy that can be selected.
 */
export type PolicySummary = { name: string, 
/**
 * What the parameter `rl_policy` takes: the name of a shipped one, `NAME@HASH` of an added one.
 */
reference: string, is_shipped: boolean, 
/**
 * Maps used in training.
 */
maps: Array<string>, seed: number, updates: number, 
/**
 * Whether it remembers what the camera has seen; it cannot be trained further on one map.
 */
has_memory: boolean, 
/**
 * Missing for shipped and uploaded policies.
 */
origin: PolicyOrigin | null, };

/**
 * Answer of `GET /api/policies`.
 */
export type Policies = { 
/**
 * The shipped ones, then the added ones, oldest first.
 */
policies: Array<PolicySummary>, };

/**
 * Body of `PATCH /api/policies/{name}`.
 */
export type PolicyName = { 
/**
 * The new name.
 */
name: string, };
