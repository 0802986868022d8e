// Measurements of a lesson while its experiment runs: a few numbers from the server's messages. Pure.

import type {
  EventMessage,
  OverlayMessage,
  SceneMessage,
  StateMessage,
} from '../../net/protocol.gen';

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
  /** Number of plans that ERRT had made by then. */
  readonly plans: number;
}

export interface Track {
  /** Number of the followed trial. */
  readonly trial: number;
  readonly time_s: number;
  readonly tool_m: readonly [number, number];
  /** Sum over the received frames: a little too small at high playback speed. */
  readonly travelled_m: number;
  readonly goalDistance_m: number | null;
  readonly greatestError_m: number;
  /** The greatest error while sub-controller 2 carried the bead without a disturbance by the hand. */
  readonly carryingError_m: number;
  readonly switches: number;
  readonly losses: number;
  /** Time of the first loss, and of the first fetch after it. */
  readonly lostAt_s: number | undefined;
  readonly fetchedAt_s: number | undefined;
  readonly disturbances: number;
  readonly deliveries: readonly Delivery[];
  readonly stopped: boolean;
  /** Longest time that the tool stayed in one place during a transport, or after it stopped without a delivery. */
  readonly lingered_s: number;
  readonly plans: number;
  readonly greatestLift: number;
  /** Height of the magnet when the bead jumped to it. */
  readonly liftedAt_m: number | undefined;
  /** Where the tool has stayed, and since when. */
  readonly anchor: { readonly at: readonly [number, number]; readonly time_s: number };
}

export function startTrack({ scene, state }: Frame): Track {
  const at = [state.tool_m[0], state.tool_m[1]] as const;
  return {
    trial: scene.trial,
    time_s: state.sim_time_s,
    tool_m: at,
    travelled_m: 0,
    goalDistance_m: state.goal_distance_m,
    greatestError_m: 0,
    carryingError_m: 0,
    switches: 0,
    losses: 0,
    lostAt_s: undefined,
    fetchedAt_s: undefined,
    disturbances: 0,
    deliveries: [],
    stopped: false,
    lingered_s: 0,
    plans: 0,
    greatestLift: 0,
    liftedAt_m: undefined,
    anchor: { at, time_s: state.sim_time_s },
  };
}

function distance_m(a: readonly [number, number], b: readonly [number, number]): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

const isLoss = ({ what }: EventMessage): boolean =>
  what.code === 'took_over' && what.sub_controller === 1;

function lingering(track: Track, state: StateMessage, at: readonly [number, number]) {
  const { anchor, lingered_s } = track;
  // At high speed few frames may arrive before the transport stops.
  const isOnItsWay = state.phase.code === 'transporting' || state.phase.code === 'stopped';
  if (!isOnItsWay || state.hand_m || distance_m(anchor.at, at) > STILL_M) {
    return { anchor: { at, time_s: state.sim_time_s }, lingered_s };
  }
  return { anchor, lingered_s: Math.max(lingered_s, state.sim_time_s - anchor.time_s) };
}

/** Deliveries from `marks`. A new one gets the number of plans known when its event arrives. */
function delivered(track: Track, marks: readonly EventMessage[], plans: number) {
  const times_s = marks.filter(({ kind }) => kind === 'delivered').map((mark) => mark.sim_time_s);
  if (times_s.length === track.deliveries.length) return track.deliveries;
  return times_s.map((time_s, index) => track.deliveries[index] ?? { time_s, plans });
}

/** The track after one more frame. Frames of another trial do not change it. */
export function observe(track: Track, { scene, state, overlay, marks }: Frame): Track {
  if (scene.trial !== track.trial) return track;
  const at = [state.tool_m[0], state.tool_m[1]] as const;
  const plans = Math.max(track.plans, overlay?.plan?.plans ?? 0);
  const lostMark = marks.find(isLoss);
  const fetchedMark = marks.find(
    (mark) => mark.kind === 'switch' && !isLoss(mark) && lostMark && mark.tick > lostMark.tick,
  );
  const isCarrying = state.phase.code === 'transporting' && state.mode === 2 && !state.hand_m;
  const error_m = state.tracking_error_m;
  return {
    trial: track.trial,
    time_s: state.sim_time_s,
    tool_m: at,
    travelled_m: track.travelled_m + distance_m(track.tool_m, at),
    goalDistance_m: state.goal_distance_m,
    greatestError_m: Math.max(track.greatestError_m, error_m),
    carryingError_m: isCarrying ? Math.max(track.carryingError_m, error_m) : track.carryingError_m,
    switches: Math.max(track.switches, state.switches),
    losses: Math.max(track.losses, marks.filter(isLoss).length),
    lostAt_s: track.lostAt_s ?? lostMark?.sim_time_s,
    fetchedAt_s: track.fetchedAt_s ?? fetchedMark?.sim_time_s,
    disturbances: Math.max(track.disturbances, state.disturbances),
    deliveries: delivered(track, marks, plans),
    stopped: track.stopped || state.phase.code === 'stopped',
    plans,
    greatestLift: Math.max(track.greatestLift, state.lift_ratio),
    liftedAt_m:
      track.liftedAt_m ?? (state.phase.code === 'lifted_off' ? state.tool_m[2] : undefined),
    ...lingering(track, state, at),
  };
}
