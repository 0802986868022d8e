// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

import type { ControllerName } from './experiment.gen';
import type { Told, VoidFact } from './facts.gen';

export type DifficultyName = "easy" | "medium" | "hard";

/**
 * How long a challenge is offered.
 */
export type Period = "day" | "week";

/**
 * What counts in an attempt: less is better.
 */
export type AttemptScore = { 
/**
 * Tick of the delivery.
 */
tick: number, 
/**
 * How many times a wall stopped the tool.
 */
walls: number, 
/**
 * How many beads were lost without a disturbance.
 */
lost_beads: number, };

/**
 * A line of a board.
 */
export type BoardEntry = { player: string, class: string | null, 
/**
 * UTC, RFC 3339.
 */
at: string, score: AttemptScore, 
/**
 * Seconds until the delivery, with the penalties.
 */
total_s: number, };

export type ChallengeSummary = { name: string, difficulty: DifficultyName, 
/**
 * `null` for one that is not offered today.
 */
period: Period | null, 
/**
 * People on its board.
 */
entries: number, best: BoardEntry | null, };

/**
 * Answer of `GET /api/challenges`.
 */
export type Challenges = { 
/**
 * Those of the day, those of the week, then the others that have a board.
 */
challenges: Array<ChallengeSummary>, };

/**
 * Answer of `GET /api/challenges/{name}`.
 */
export type ChallengeReport = { name: string, difficulty: DifficultyName, map: string, 
/**
 * Start of the bead.
 */
start_m: [number, number], goal_m: [number, number], 
/**
 * Shortest path of the bead.
 */
path_m: number, 
/**
 * How often the bead is moved away.
 */
disturbances: number, 
/**
 * An attempt that has not delivered by then has no score.
 */
time_limit_s: number, 
/**
 * Penalty for each time that a wall stops the tool.
 */
wall_s: number, 
/**
 * Penalty for each bead that is lost without a disturbance.
 */
lost_bead_s: number, 
/**
 * Best first.
 */
board: Array<BoardEntry>, };

export type MishapKind = "wall" | "lost_bead" | "disturbance";

/**
 * Something that costs time.
 */
export type MishapMessage = { tick: number, kind: MishapKind, };

/**
 * Places every .2 s, beginning at tick 1; the last ones are those of the delivery.
 */
export type TraceMessage = { tool_m: Array<[number, number]>, bead_m: Array<[number, number]>, mishaps: Array<MishapMessage>, };

/**
 * A run on the challenge, by a controller or by the best person.
 */
export type GhostMessage = { controller: ControllerName, 
/**
 * Name of the person; `null` for a controller.
 */
player: string | null, 
/**
 * `null` if it has not delivered in time.
 */
score: AttemptScore | null, 
/**
 * Seconds with the penalties; `null` without a delivery.
 */
total_s: number | null, trace: TraceMessage, };

/**
 * Answer of `GET /api/challenges/{name}/ghosts`.
 */
export type Ghosts = { 
/**
 * Seconds between two places of a trace.
 */
sample_s: number, ghosts: Array<GhostMessage>, };

/**
 * The part of an attempt in which it lost the most time, compared with the fastest ghost.
 */
export type LossMessage = { from_tick: number, to_tick: number, 
/**
 * The bead at `from_tick`.
 */
place_m: [number, number], lost_s: number, walls: number, lost_beads: number, disturbances: number, };

/**
 * An input log with its claim.
 */
export type AttemptMessage = { log: unknown, score: AttemptScore, 
/**
 * Hash of the world at the tick of the delivery, 16 hexadecimal digits.
 */
world_hash: string, };

/**
 * Answer of `GET /api/sessions/{id}/attempt`.
 */
export type AttemptReport = { challenge: string, 
/**
 * Shortest path that the bead still has.
 */
remaining_m: number, loss: LossMessage | null, 
/**
 * Whom the loss is compared with; `null` for the tool's speed: no controller delivered, or the bead is moved away.
 */
compared_with: ControllerName | null, 
/**
 * What `POST /api/challenges/{name}/attempts` takes; `null` without a delivery.
 */
attempt: AttemptMessage | null, };

/**
 * Body of `POST /api/challenges/{name}/attempts`.
 */
export type AttemptQuery = { 
/**
 * The session in which it was played, and still is.
 */
session: string, 
/**
 * `seat` of the `hello` of the browser that began it.
 */
seat: string, 
/**
 * No control characters, and none that hide or turn letters.
 */
player: string, 
/**
 * Name of a class.
 */
class?: string, attempt: AttemptMessage, };

/**
 * Answer of `POST /api/challenges/{name}/attempts`.
 */
export type AttemptAnswer = { total_s: number, 
/**
 * Whether it is the person's best and therefore on the board.
 */
is_kept: boolean, 
/**
 * Place on the board, from 1, of the person's best; `null` if it is not on it.
 */
place: number | null, 
/**
 * People on the board.
 */
entries: number, };

/**
 * The attempt that is being played, as `state.attempt`.
 */
export type AttemptStanding = { walls: number, lost_beads: number, 
/**
 * Seconds with the penalties so far.
 */
total_s: number, is_delivered: boolean, 
/**
 * Not delivered within the time limit.
 */
is_time_up: boolean, 
/**
 * Why it does not count.
 */
void: Told<VoidFact> | null, };
