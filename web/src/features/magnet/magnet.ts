// What the magnet can do with the current parameters: requests to the server, and answers as text.

import { centimetres, fixed, millimetres } from '../../ui/format';
import { storedRange } from '../../lab/parameters';
import {
  FARTHEST_CAPTURE_M,
  type Parameters,
  type PullCurve,
  type PullQuery,
  type ReachCurve,
  type ReachQuery,
} from '../../net/protocol.gen';

/** Direction from the block to the bead: along one of its sides, or the present direction. */
export const SIDES = [
  ['x', 'x'],
  ['y', 'y'],
  ['bead', 'the bead'],
] as const;
export type Side = (typeof SIDES)[number][0];

/** Heights that the form offers. */
export const HEIGHTS_M = storedRange('tool_height_m');
/** An offset every 2 mm. */
const OFFSETS = 251;
/** One height per 2 mm. */
const HEIGHTS = 56;
/** Below this drag any speed is possible, and the server has nothing to calculate. */
const MIN_DRAG_N_S_M = 1e-6;
/** Possible ends of the offset axis. */
const SHOWN_M = [0.15, 0.2, 0.3];

export function rolls(parameters: Parameters): boolean {
  return (
    parameters.bead_motion === 'rolling' && parameters.rolling_resistance < parameters.friction
  );
}

/** Pull at which a resting bead starts to move, as a multiple of its load. */
export function breakaway(parameters: Parameters): number {
  return rolls(parameters) ? parameters.rolling_resistance : parameters.friction;
}

/** A bead nearer than this has no useful direction. */
const NEAREST_M = 0.001;
/** The curves change little within this angle. The step limits the requests while the bead moves. */
const DIRECTION_STEP_RAD = Math.PI / 36;

/** Angle from x toward y. The block's sides are parallel to the table's axes. */
export function directionOf(
  side: Side,
  tool_m: readonly number[],
  bead_m: readonly number[],
): number {
  if (side !== 'bead') return side === 'x' ? 0 : Math.PI / 2;
  const x_m = (bead_m[0] ?? 0) - (tool_m[0] ?? 0);
  const y_m = (bead_m[1] ?? 0) - (tool_m[1] ?? 0);
  if (Math.hypot(x_m, y_m) < NEAREST_M) return 0;
  return Math.round(Math.atan2(y_m, x_m) / DIRECTION_STEP_RAD) * DIRECTION_STEP_RAD;
}

function common(
  parameters: Parameters,
  direction_rad: number,
): Pick<PullQuery, 'orientation' | 'direction_rad' | 'friction'> {
  return {
    orientation: parameters.block_orientation,
    direction_rad,
    friction: breakaway(parameters),
  };
}

export function pullQuery(parameters: Parameters, direction_rad: number): PullQuery {
  return {
    ...common(parameters, direction_rad),
    lower_face_height_m: parameters.tool_height_m,
    farthest_m: FARTHEST_CAPTURE_M,
    count: OFFSETS,
  };
}

/** For all heights or for the current one. */
export function reachQuery(
  parameters: Parameters,
  direction_rad: number,
  at: 'all' | 'here',
): ReachQuery {
  const height_m = parameters.tool_height_m;
  const [lowest_m, highest_m] = at === 'all' ? HEIGHTS_M : [height_m, height_m];
  return {
    ...common(parameters, direction_rad),
    lowest_m,
    highest_m,
    drag_n_s_m: Math.max(MIN_DRAG_N_S_M, parameters.drag_n_s_m),
    // The server does not accept a curve of one point.
    count: at === 'all' ? HEIGHTS : 2,
  };
}

/** Force that friction can hold, in bead weights, for each offset; null where the bead lifts off. */
export function heldRatio(curve: PullCurve, friction: number): (number | null)[] {
  return curve.weight_ratio.map((left, k) => (curve.is_lifted[k] ? null : friction * left));
}

/** Smallest end of the offset axis that shows the whole capture range with a margin. */
export function shownOffset(capture_m: PullCurve['capture_m']): number {
  return SHOWN_M.find((end_m) => (capture_m?.[1] ?? 0) < 0.9 * end_m) ?? FARTHEST_CAPTURE_M;
}

export function captureWords(capture_m: PullCurve['capture_m']): string {
  if (!capture_m) return 'nothing';
  const [inner_m, outer_m] = capture_m;
  // Do not round to 0: right below the magnet the bead is not pulled.
  const digits = inner_m > 0 && inner_m < 0.001 ? 2 : 1;
  return outer_m >= FARTHEST_CAPTURE_M
    ? `from ${centimetres(inner_m, digits)}`
    : `${fixed(100 * inner_m, digits)} to ${centimetres(outer_m)}`;
}

/** `Between 0.4 and 9.5 cm the pull is stronger than friction: the bead follows.` */
export function captureSentence(capture_m: PullCurve['capture_m']): string {
  if (!capture_m) return 'Nowhere is the pull stronger than friction: the bead does not follow.';
  const [inner_m, outer_m] = capture_m;
  const where =
    outer_m >= FARTHEST_CAPTURE_M
      ? `Beyond ${centimetres(inner_m)}`
      : `Between ${fixed(100 * inner_m, 1)} and ${centimetres(outer_m)}`;
  return `${where} the pull is stronger than friction: the bead follows.`;
}

export function weightWords(curve: PullCurve): string {
  const left = curve.weight_ratio[0];
  if (left === undefined) return '–';
  return curve.is_lifted[0] ? 'none: lifts off' : `${fixed(left * 100, 0)} %`;
}

export function speedWords(reach: ReachCurve, parameters: Parameters): string {
  const speed_m_s = reach.largest_speed_m_s[0];
  if (speed_m_s === undefined) return '–';
  if (speed_m_s === null) return 'no speed';
  return parameters.drag_n_s_m < MIN_DRAG_N_S_M
    ? 'any speed'
    : `${fixed(speed_m_s * 1000, 0)} mm/s`;
}

/** The pull at one of the curve's offsets. */
export function pullWords(curve: PullCurve, friction: number, index: number): string | undefined {
  const offset_m = curve.offset_m[index];
  const lift = curve.lift_ratio[index];
  const lateral = curve.lateral_ratio[index];
  if (offset_m === undefined || lift === undefined || lateral === undefined) return undefined;
  const held = heldRatio(curve, friction)[index];
  const holds = typeof held === 'number' ? `friction holds ${fixed(held, 2)}` : 'lifted off';
  return `${centimetres(offset_m)} to the side: lift ${fixed(lift, 2)}, pull ${fixed(lateral, 2)}, ${holds}`;
}

/** Capture and speed at one of the curve's heights. */
export function reachWords(reach: ReachCurve, index: number): string | undefined {
  const height_m = reach.lower_face_height_m[index];
  if (height_m === undefined) return undefined;
  const speed_m_s = reach.largest_speed_m_s[index];
  const follows =
    typeof speed_m_s === 'number' ? `, follows ${fixed(speed_m_s * 1000, 0)} mm/s` : '';
  return `At ${millimetres(height_m)}: captures ${captureWords(reach.capture_m[index] ?? null)}${follows}`;
}
