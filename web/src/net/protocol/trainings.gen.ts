// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

/**
 * Recipe from which the settings start.
 */
export type RecipeName = "quick" | "full" | "paper" | "toy";

/**
 * How image, tool and goal come together in the network.
 */
export type FusionName = "early" | "late";

/**
 * Settings that differ from the recipe, named as in `ferry train --set`. A missing one is the recipe's.
 */
export type TrainingSettings = { 
/**
 *How often the network is corrected: more updates take longer and end better.
 */
updates: number | null, 
/**
 *How far each update moves the network in the first half: too small is slow, too large forgets.
 */
learning_rate: number | null, 
/**
 *How much a reward counts one step later: near 1, the goal is felt from far away.
 */
discount: number | null, 
/**
 *The share of steps in a random direction, so that the robot finds new routes.
 */
exploration: number | null, 
/**
 *Noise inside the network makes it try other steps where it is not sure.
 */
noisy: boolean | null, 
/**
 *Reward for each step that shortens the path to the goal: it shows the direction early.
 */
progress_reward: number | null, 
/**
 *Subtracted at each step, so that short paths are worth more.
 */
step_penalty: number | null, 
/**
 *How many real rewards are added up before the network’s own estimate takes over.
 */
n_step: number | null, 
/**
 *Where the network joins image and goal: early is that of the paper, late learns faster.
 */
fusion: FusionName | null, };

/**
 * Body of `POST /api/trainings`.
 */
export type TrainingQuery = { 
/**
 * Name of a map, shipped or added.
 */
map: string, 
/**
 * Name of the policy that it becomes: up to 40 of a to z, 0 to 9, - and _.
 */
name: string, seed: number, recipe: RecipeName, settings: TrainingSettings, 
/**
 * Policy whose weights it starts from; `null`: random weights.
 */
start_from: string | null, 
/**
 * Goal of the value maps; `null`: a place far from the others.
 */
goal_m: [number, number] | null, };

export type TrainingStage = "waiting" | "images" | "learning" | "examination" | "paused" | "done" | "cancelled" | "failed";

/**
 * Episodes without exploration, with random starts and goals; on a map of at most 63 cells, with all of them.
 */
export type Examination = { episodes: number, 
/**
 * Within 2 cm of the goal.
 */
reached: number, 
/**
 * Into a wall.
 */
collided: number, 
/**
 * Out of steps.
 */
timed_out: number, 
/**
 * Wilson 95 % interval of `reached / episodes`.
 */
reached_wilson95: [number, number], 
/**
 * Whether the episodes are all pairs of a start and a goal, each once: then there is nothing left to estimate.
 */
all_pairs: boolean, };

/**
 * A hundred updates of a training.
 */
export type TrainingPoint = { 
/**
 * Updates at the end of the point.
 */
update: number, 
/**
 * Steps of all episodes so far.
 */
steps: number, 
/**
 * Finished episodes so far.
 */
episodes: number, 
/**
 * Mean total reward of the episodes that ended in this point; `null` without any.
 */
reward_mean: number | null, 
/**
 * Standard deviation of these rewards.
 */
reward_deviation: number | null, loss_mean: number | null, 
/**
 * Episodes that ended in this point, with exploration.
 */
ended: number, 
/**
 * Number of these that reached their goal.
 */
reached: number, 
/**
 * A small examination, on some points.
 */
examined: Examination | null, };

/**
 * A training without its curve.
 */
export type TrainingSummary = { id: string, query: TrainingQuery, stage: TrainingStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, updates: number, 
/**
 * Updates at its end.
 */
updates_total: number, steps: number, episodes: number, 
/**
 * Time spent on it, without pauses.
 */
elapsed_s: number, 
/**
 * Estimated time until its end, while it learns.
 */
left_s: number | null, 
/**
 * The last examination, of 1000 episodes or all pairs; before the end, the newest small one.
 */
examined: Examination | null, 
/**
 * Rank correlation between values and distances to the goal of the value maps, of the newest one.
 */
rank_correlation: number | null, 
/**
 * Number of value maps.
 */
frames: number, 
/**
 * Smallest and greatest value of all value maps so far.
 */
value_range: [number, number] | null, 
/**
 * Its policy, as `rl_policy` takes it, once it is done.
 */
policy: string | null, };

/**
 * Answer of `GET /api/trainings/{id}`.
 */
export type TrainingReport = { curve: Array<TrainingPoint>, id: string, query: TrainingQuery, stage: TrainingStage, 
/**
 * Why it failed, if it did.
 */
message: string | null, updates: number, 
/**
 * Updates at its end.
 */
updates_total: number, steps: number, episodes: number, 
/**
 * Time spent on it, without pauses.
 */
elapsed_s: number, 
/**
 * Estimated time until its end, while it learns.
 */
left_s: number | null, 
/**
 * The last examination, of 1000 episodes or all pairs; before the end, the newest small one.
 */
examined: Examination | null, 
/**
 * Rank correlation between values and distances to the goal of the value maps, of the newest one.
 */
rank_correlation: number | null, 
/**
 * Number of value maps.
 */
frames: number, 
/**
 * Smallest and greatest value of all value maps so far.
 */
value_range: [number, number] | null, 
/**
 * Its policy, as `rl_policy` takes it, once it is done.
 */
policy: string | null, };

/**
 * Answer of `GET /api/trainings`.
 */
export type Trainings = { 
/**
 * In the order of submission.
 */
trainings: Array<TrainingSummary>, };

/**
 * The cells of a training's map: all lists of its value maps have this order.
 */
export type TrainingCells = { 
/**
 * Distance between two cells.
 */
spacing_m: number, 
/**
 * Goal of the value maps.
 */
goal_m: [number, number], centers_m: Array<[number, number]>, 
/**
 * Steps of the shortest path to the goal; `null` without a path.
 */
steps: Array<number | null>, };

/**
 * How an episode ends, or would end if it began at a cell.
 */
export type EpisodeEnding = "reached" | "collided" | "timed_out";

/**
 * An episode as the cells that the tool visits.
 */
export type TrainingEpisode = { 
/**
 * Indices of cells.
 */
cells: Array<number>, ending: EpisodeEnding, };

/**
 * A value map of a training: what its network thinks after a number of updates.
 */
export type TrainingFrame = { update: number, 
/**
 * Value of the best action, one entry per cell.
 */
values: Array<number>, 
/**
 * Index of the best action: +x, −x, +y, −y.
 */
actions: Array<number>, 
/**
 * Quantiles .05, .25, .5, .75 and .95 of the return of the best action.
 */
quantiles: Array<[number, number, number, number, number]>, 
/**
 * How an episode without exploration ends that begins at the cell.
 */
endings: Array<EpisodeEnding>, 
/**
 * Spearman’s rank correlation of the values with the distances, over all cells outside the goal; `null` if all values are equal.
 */
rank_correlation: number | null, 
/**
 * Episodes to the goal without exploration.
 */
greedy: Array<TrainingEpisode>, 
/**
 * Episodes to the goal with exploration, from the same starts.
 */
exploring: Array<TrainingEpisode>, };
