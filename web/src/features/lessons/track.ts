// Measurements of a lesson while its experiment runs: a few numbers from the server's messages. Pure.

import { CONTROL_PERIOD_S } from '../../net/protocol.gen';
import type {
  EventMessage,
  OverlayMessage,
  SceneMessage,
  StateMessage,
} from '../../net/protocol.gen';
import { distance, type Vec2 } from '../../lab/geometry';

/** A tool that moves less than this counts as staying in one place. */
const STILL_M = 0.03;

export interface Frame {
  readonly scene: SceneMessage;
  readonly state: StateMessage;
  readonly overlay: OverlayMessage | undefined;
  /** Events of the trial, oldest first. */
  readonly marks: readonly EventMessage[];
}

export interface Delivery {
  readonly time_s: number;
  /** The goal of that time; null if its placing is not known. */
  readonly goal_m: Vec2 | null;
  /** Number of plans that ERRT had made by then. */
  readonly plans: number;
}

/** What is measured, before the first tick. */
const NOTHING = {
  /** Sum over the received frames: a little too small at high playback speed. */
  travelled_m: 0,
  greatestError_m: 0,
  /** The greatest error while sub-controller 2 carried the bead without a disturbance by the hand. */
  carryingError_m: 0,
  switches: 0,
  losses: 0,
  /** Time of the first loss, and of the first fetch after it. */
  lostAt_s: undefined as number | undefined,
  fetchedAt_s: undefined as number | undefined,
  disturbances: 0,
  deliveries: [] as readonly Delivery[],
  stopped: false,
  /** Longest time that the tool stayed in one place during a transport, or after it stopped without a delivery. */
  lingered_s: 0,
  plans: 0,
  greatestLift: 0,
  /** Height of the magnet when the bead jumped to it. */
  liftedAt_m: undefined as number | undefined,
};

/** A place is the same within the rounding of links. */
const SAME_M = 0.001;

export const isSame = (one: Vec2 | null, other: Vec2 | null): boolean =>
  one !== null && other !== null && distance(one, other) < SAME_M;

/** Deliveries to a goal: that of the run, if no other is named. */
export const deliveriesTo = (track: Track, goal_m = track.runGoal_m): readonly Delivery[] =>
  track.deliveries.filter((one) => isSame(one.goal_m, goal_m));

/** What the newest frame shows. */
const present = ({ scene, state }: Frame) => ({
  /** Number of the followed trial. */
  trial: scene.trial,
  time_s: state.sim_time_s,
  tool_m: [state.tool_m[0], state.tool_m[1]] as Vec2,
  goalDistance_m: state.goal_distance_m,
});

/** Where the tool has stayed, and since when. */
const anchorAt = (now: ReturnType<typeof present>) => ({ at: now.tool_m, time_s: now.time_s });

export function startTrack(frame: Frame) {
  const now = present(frame);
  const goal = frame.scene.scenario.goal_m;
  /** The goal with which the run begins. */
  const runGoal_m: Vec2 | null = goal && [goal[0], goal[1]];
  return { ...NOTHING, ...now, runGoal_m, anchor: anchorAt(now) };
}

export type Track = Readonly<ReturnType<typeof startTrack>>;

const isLoss = ({ what }: EventMessage): boolean =>
  what.code === 'took_over' && what.sub_controller === 1;

function lingering({ anchor, lingered_s }: Track, frame: Frame) {
  const [{ phase, hand_m }, now] = [frame.state, present(frame)];
  // At high speed few frames may arrive before the transport stops.
  const isOnItsWay = phase.code === 'transporting' || phase.code === 'stopped';
  if (!isOnItsWay || hand_m || distance(anchor.at, now.tool_m) > STILL_M) {
    return { anchor: anchorAt(now), lingered_s };
  }
  return { anchor, lingered_s: Math.max(lingered_s, now.time_s - anchor.time_s) };
}

/**
 * Deliveries from `marks`, each with its goal and the number of plans by then. One that the overlay has not reached waits:
 * its event may arrive before the overlay of the same control step.
 */
function delivered(track: Track, { scene, overlay, marks }: Frame, plans: number) {
  const seen_s = ((overlay?.tick ?? Infinity) + 0.5) * scene.tick_s + CONTROL_PERIOD_S;
  let goal_m = track.runGoal_m;
  const found: Delivery[] = [];
  for (const { kind, what, sim_time_s: time_s } of marks) {
    if (what.code === 'goal_placed') goal_m = [what.x_m, what.y_m];
    else if (kind === 'delivered' && time_s <= seen_s) found.push({ time_s, goal_m, plans });
  }
  if (found.length === track.deliveries.length) return track.deliveries;
  return found.map((one, index) => track.deliveries[index] ?? one);
}

/** The track after one more frame. Frames of another trial do not change it. */
export function observe(track: Track, frame: Frame): Track {
  const { scene, state, overlay, marks } = frame;
  if (scene.trial !== track.trial) return track;
  const now = present(frame);
  const plans = Math.max(track.plans, overlay?.plan?.plans ?? 0);
  const lost = marks.find(isLoss);
  const fetched = marks.find(
    (mark) => mark.kind === 'switch' && !isLoss(mark) && lost && mark.tick > lost.tick,
  );
  const isCarrying = state.phase.code === 'transporting' && state.mode === 2 && !state.hand_m;
  const carried_m = isCarrying ? state.tracking_error_m : 0;
  return {
    ...now,
    runGoal_m: track.runGoal_m,
    travelled_m: track.travelled_m + distance(track.tool_m, now.tool_m),
    greatestError_m: Math.max(track.greatestError_m, state.tracking_error_m),
    carryingError_m: Math.max(track.carryingError_m, carried_m),
    switches: Math.max(track.switches, state.switches),
    losses: Math.max(track.losses, marks.filter(isLoss).length),
    lostAt_s: track.lostAt_s ?? lost?.sim_time_s,
    fetchedAt_s: track.fetchedAt_s ?? fetched?.sim_time_s,
    disturbances: Math.max(track.disturbances, state.disturbances),
    deliveries: delivered(track, frame, plans),
    stopped: track.stopped || state.phase.code === 'stopped',
    plans,
    greatestLift: Math.max(track.greatestLift, state.lift_ratio),
    liftedAt_m:
      track.liftedAt_m ?? (state.phase.code === 'lifted_off' ? state.tool_m[2] : undefined),
    ...lingering(track, frame),
  };
}
