// What the magnet can do for the parameters in force: questions to the server, answers in words.

import { fixed, millimetres } from '../../ui/format';
import { storedRange } from '../../lab/parameters';
import {
  FARTHEST_CAPTURE_M,
  type Parameters,
  type PullCurve,
  type PullQuery,
  type ReachCurve,
  type ReachQuery,
} from '../../net/protocol.gen';

/** Where the bead lies beside the block: along one of its sides, or where it is now. */
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
/** A height every 2 mm. */
const HEIGHTS = 56;
/** Without drag no speed is too large, and there is nothing to compute. */
const LEAST_DRAG_N_S_M = 1e-6;
/** Ends of the axis of offsets. */
const SHOWN_M = [0.15, 0.2, 0.3];

export function rolls(parameters: Parameters): boolean {
  return (
    parameters.bead_motion === 'rolling' && parameters.rolling_resistance < parameters.friction
  );
}

/** The pull, in units of the load, at which a resting bead begins to move. */
export function breakaway(parameters: Parameters): number {
  return rolls(parameters) ? parameters.rolling_resistance : parameters.friction;
}

/** A bead nearer than this lies in no direction worth the name. */
const NEAREST_M = 0.001;
/** The curves change little within this angle, and a moving bead asks less often. */
const DIRECTION_STEP_RAD = Math.PI / 36;

/** From the block's x toward its y; the block's sides are those of the table. */
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

/** Over all heights, or at the one in force. */
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
    drag_n_s_m: Math.max(LEAST_DRAG_N_S_M, parameters.drag_n_s_m),
    // The server draws no curve of one point.
    count: at === 'all' ? HEIGHTS : 2,
  };
}

/** What friction can hold, in weights, over the offset; nothing where the bead lifts off. */
export function heldRatio(curve: PullCurve, friction: number): (number | null)[] {
  return curve.weight_ratio.map((left, k) => (curve.is_lifted[k] ? null : friction * left));
}

/** Least end of the axis of offsets with the whole capture on it, and some room. */
export function shownOffset(capture_m: PullCurve['capture_m']): number {
  return SHOWN_M.find((end_m) => (capture_m?.[1] ?? 0) < 0.9 * end_m) ?? FARTHEST_CAPTURE_M;
}

export function captureWords(capture_m: PullCurve['capture_m']): string {
  if (!capture_m) return 'nothing';
  const [inner_m, outer_m] = capture_m;
  // Rounding must not say that a bead right below the magnet is dragged.
  const digits = inner_m > 0 && inner_m < 0.001 ? 1 : 0;
  return outer_m >= FARTHEST_CAPTURE_M
    ? `from ${millimetres(inner_m, digits)} on`
    : `${fixed(inner_m * 1000, digits)} to ${millimetres(outer_m)}`;
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
  return parameters.drag_n_s_m < LEAST_DRAG_N_S_M
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
  return `${millimetres(offset_m)} beside: lift ${fixed(lift, 2)}, pull ${fixed(lateral, 2)}, ${holds}`;
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
