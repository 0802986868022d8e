// The attractor's flow field: what to ask for, how long its arrows are, where they end. Pure.

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
/** Of the spacing: the longest arrow, which leaves a gap to the next. */
const LONGEST = 0.85;
/** Of the greatest speed: below it nothing moves. */
const STILL = 0.02;
/** Within this of the goal the bead is delivered. */

/** In units of the spacing: a stride along the flow, and how far one gets in so many strides at least. */
const STRIDE = 0.3;
const AROUND = 1.2;
const AROUND_STRIDES = 40;
const MOST_STRIDES = 800;

export function flowSpacingM(area: Rect): number {
  const side_m = Math.max(area.x_max_m - area.x_min_m, area.y_max_m - area.y_min_m);
  return Math.min(MOST_FLOW_SPACING_M, Math.max(LEAST_FLOW_SPACING_M, side_m / PLACES_ACROSS));
}

export function flowQuery(scene: SceneMessage, seen: SeenMessage): FlowQuery {
  return { spacing_m: flowSpacingM(scene.workspace), seen: seen.number };
}

/** What the flow follows from besides the question: the server takes it from the session. */
export function flowKey(scene: SceneMessage, goal_m: readonly number[]): string {
  return JSON.stringify([scene.trial, scene.parameters, goal_m]);
}

function placeM(field: FlowField, column: number, row: number): Vec2 {
  return [field.origin_m[0] + column * field.spacing_m, field.origin_m[1] + row * field.spacing_m];
}

/** Whether the camera has shown a point: elsewhere the flow knows of no walls, and means little. */
export type IsSeen = (point_m: Vec2) => boolean;

function fastest(field: FlowField): number {
  return field.velocity_m_s.reduce((most, v) => (v ? Math.max(most, Math.hypot(...v)) : most), 0);
}

/** An arrow a place where something moves, as long as it is fast there. */
export function flowArrows(field: FlowField, isSeen: IsSeen): Arrow[] {
  const most_m_s = fastest(field);
  const half_s = (0.5 * LONGEST * field.spacing_m) / most_m_s;
  return field.velocity_m_s.flatMap((velocity, place) => {
    if (!velocity || Math.hypot(...velocity) <= STILL * most_m_s) return [];
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

/** Between the places, from those of the four around that have a velocity; columns and rows as coordinates. */
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
 * Where one ends who follows the flow from a place, in columns and rows; nothing if it is the goal, or if the way
 * leaves what was seen.
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
  for (let stride = 0; stride < MOST_STRIDES; stride++) {
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
 * Where the attractor gets trapped: the places, in metres, at which the arrows end short of the goal.
 *
 * The field seldom has a place where it stands still: it runs against a wall, and beyond a line back again. So it
 * is followed from every place, over what was seen.
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
