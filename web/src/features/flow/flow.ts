// The attractor's flow field: the request, the lengths of the arrows, the traps. Pure.

import {
  LEAST_FLOW_SPACING_M,
  MOST_FLOW_SPACING_M,
  type FlowField,
  type FlowQuery,
  GOAL_RADIUS_M,
  type Rect,
  type SceneMessage,
  type SeenMessage,
} from '../../net/protocol.gen';
import { distance, type Vec2 } from '../../lab/geometry';
import type { Arrow } from '../../plan/arrows';

const PLACES_ACROSS = 40;
/** Length of the longest arrow, as a share of the spacing. */
const LONGEST = 0.85;
/** Below this share of the greatest speed the flow counts as zero. */
const STILL = 0.02;

/** Step length along the flow, number of steps, and the smallest distance covered by them, in units of the spacing. */
const STRIDE = 0.3;
const AROUND = 1.2;
const AROUND_STRIDES = 40;
const MAX_STRIDES = 800;

export function flowSpacingM(area: Rect): number {
  const side_m = Math.max(area.x_max_m - area.x_min_m, area.y_max_m - area.y_min_m);
  return Math.min(MOST_FLOW_SPACING_M, Math.max(LEAST_FLOW_SPACING_M, side_m / PLACES_ACROSS));
}

export function flowQuery(scene: SceneMessage, seen: SeenMessage): FlowQuery {
  return { spacing_m: flowSpacingM(scene.workspace), seen: seen.number };
}

/** What the flow depends on besides the request. The server takes it from the session. */
export function flowKey(scene: SceneMessage, goal_m: readonly number[]): string {
  return JSON.stringify([scene.trial, scene.parameters, goal_m]);
}

function placeM(field: FlowField, column: number, row: number): Vec2 {
  return [field.origin_m[0] + column * field.spacing_m, field.origin_m[1] + row * field.spacing_m];
}

/** Whether the camera has shown a point. Elsewhere the flow ignores walls. */
export type IsSeen = (point_m: Vec2) => boolean;

function fastest(field: FlowField): number {
  return field.velocity_m_s.reduce((most, v) => (v ? Math.max(most, Math.hypot(...v)) : most), 0);
}

/** One arrow per place with a flow; its length grows with the speed. */
export function flowArrows(field: FlowField, isSeen: IsSeen): Arrow[] {
  const max_m_s = fastest(field);
  const half_s = (0.5 * LONGEST * field.spacing_m) / max_m_s;
  return field.velocity_m_s.flatMap((velocity, place) => {
    if (!velocity || Math.hypot(...velocity) <= STILL * max_m_s) return [];
    const at = placeM(field, place % field.columns, Math.floor(place / field.columns));
    const [dx, dy] = [velocity[0] * half_s, velocity[1] * half_s];
    const arrow: Arrow = {
      from_m: [at[0] - dx, at[1] - dy],
      to_m: [at[0] + dx, at[1] + dy],
      isSeen: isSeen(at),
    };
    return [arrow];
  });
}

/** Velocity between the places, interpolated from the neighbours that have one. Coordinates are columns and rows. */
function velocityAt(field: FlowField, x: number, y: number): Vec2 | undefined {
  const [column, row] = [Math.floor(x), Math.floor(y)];
  let [sumX, sumY, weights] = [0, 0, 0];
  for (const [i, j] of [
    [column, row],
    [column + 1, row],
    [column, row + 1],
    [column + 1, row + 1],
  ] as const) {
    const velocity = i < field.columns ? field.velocity_m_s[j * field.columns + i] : undefined;
    if (!velocity) continue;
    const weight = (1 - Math.abs(x - i)) * (1 - Math.abs(y - j));
    sumX += weight * velocity[0];
    sumY += weight * velocity[1];
    weights += weight;
  }
  return weights > 1e-9 ? [sumX / weights, sumY / weights] : undefined;
}

/**
 * End of the flow line from a place, in columns and rows; undefined if it is the goal, or if the line leaves the
 * observed area.
 */
function endFrom(
  field: FlowField,
  start: Vec2,
  goal: Vec2,
  still_m_s: number,
  isSeen: IsSeen,
): Vec2 | undefined {
  const near = Math.max(1, GOAL_RADIUS_M / field.spacing_m);
  let at = start;
  let around = { at, strides: 0 };
  for (let stride = 0; stride < MAX_STRIDES; stride++) {
    if (distance(at, goal) <= near || !isSeen(placeM(field, ...at))) return undefined;
    const velocity = velocityAt(field, ...at);
    const speed_m_s = velocity ? Math.hypot(...velocity) : 0;
    if (!velocity || speed_m_s <= still_m_s) return at;
    at = [
      Math.min(field.columns - 1, Math.max(0, at[0] + (STRIDE * velocity[0]) / speed_m_s)),
      Math.min(field.rows - 1, Math.max(0, at[1] + (STRIDE * velocity[1]) / speed_m_s)),
    ];
    if (distance(at, around.at) > AROUND) around = { at, strides: 0 };
    else if (++around.strides > AROUND_STRIDES) return at;
  }
  return at;
}

/**
 * The places, in metres, where the flow ends before the goal.
 *
 * The flow is rarely zero at a trap: it runs against a wall and back again. So the flow is followed from every place
 * in the observed area.
 */
export function flowTraps(field: FlowField, goal_m: Vec2, isSeen: IsSeen): Vec2[] {
  const goal: Vec2 = [
    (goal_m[0] - field.origin_m[0]) / field.spacing_m,
    (goal_m[1] - field.origin_m[1]) / field.spacing_m,
  ];
  const still_m_s = STILL * fastest(field);
  const ends = new Set<number>();
  field.velocity_m_s.forEach((velocity, place) => {
    if (!velocity) return;
    const start: Vec2 = [place % field.columns, Math.floor(place / field.columns)];
    const end = endFrom(field, start, goal, still_m_s, isSeen);
    if (end) ends.add(Math.round(end[1]) * field.columns + Math.round(end[0]));
  });
  return [...ends].map((end) =>
    placeM(field, end % field.columns, Math.floor(end / field.columns)),
  );
}
