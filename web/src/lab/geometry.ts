// Points of the table, in metres (x right, y up).

import type { Rect } from '../net/protocol.gen';

export type Vec2 = readonly [number, number];

/** Converts between the table and a view of it: from above or in perspective. */
export interface TableView {
  /** The point of the table at a pixel; undefined if the view shows no table there, as above the horizon. */
  readonly toWorld: (px: Vec2) => [number, number] | undefined;
  /** The pixel of a point on or above the table; undefined behind the scene camera. */
  readonly toPx: (point: Vec2, height_m?: number) => [number, number] | undefined;
}

export const distance = (a: Vec2, b: Vec2): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** The point at a share of the way from one to another. */
export function between(from: Vec2, to: Vec2, share: number): [number, number] {
  return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
}

/** The place after some steps of a way, which may be a fraction; at its end from then on. */
export function placeAfter(places: readonly Vec2[], steps: number): Vec2 | undefined {
  const [from, to] = [places[Math.floor(steps)], places[Math.floor(steps) + 1]];
  return from && to ? between(from, to, steps % 1) : places.at(-1);
}

/** Distance of a point from the straight line between two others. */
export function distanceToLine(at: Vec2, from: Vec2, to: Vec2): number {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const along = ((at[0] - from[0]) * dx + (at[1] - from[1]) * dy) / (dx * dx + dy * dy || 1);
  return distance(at, between(from, to, Math.min(1, Math.max(0, along))));
}

export function clampToRect(rect: Rect, point: Vec2): [number, number] {
  return [
    Math.min(rect.x_max_m, Math.max(rect.x_min_m, point[0])),
    Math.min(rect.y_max_m, Math.max(rect.y_min_m, point[1])),
  ];
}

/** Counterclockwise, from the smallest x and y. */
export function cornersOf({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): [number, number][] {
  return [
    [x_min_m, y_min_m],
    [x_max_m, y_min_m],
    [x_max_m, y_max_m],
    [x_min_m, y_max_m],
  ];
}

/** The smallest rectangle around some others. */
export function around(...rects: readonly Rect[]): Rect {
  return {
    x_min_m: Math.min(...rects.map((rect) => rect.x_min_m)),
    x_max_m: Math.max(...rects.map((rect) => rect.x_max_m)),
    y_min_m: Math.min(...rects.map((rect) => rect.y_min_m)),
    y_max_m: Math.max(...rects.map((rect) => rect.y_max_m)),
  };
}

/** An outline and its holes. */
export interface Filled {
  readonly exterior: readonly Vec2[];
  readonly holes: readonly (readonly Vec2[])[];
}

function crossings(ring: readonly Vec2[], [x, y]: Vec2): number {
  let count = 0;
  let previous = ring.at(-1);
  for (const vertex of ring) {
    if (previous && vertex[1] > y !== previous[1] > y) {
      const slope = (previous[0] - vertex[0]) / (previous[1] - vertex[1]);
      if (x < vertex[0] + (y - vertex[1]) * slope) count += 1;
    }
    previous = vertex;
  }
  return count;
}

/** Whether `point` is in the filled part of `polygon`: even-odd over the exterior and the holes. */
export function insidePolygon({ exterior, holes }: Filled, point: Vec2): boolean {
  const counts = [exterior, ...holes].map((ring) => crossings(ring, point));
  return counts.reduce((sum, count) => sum + count) % 2 === 1;
}

/** Index of the place with the least cost; undefined if each costs infinitely much. */
export function leastOf(
  places: readonly Vec2[],
  cost: (place: Vec2) => number,
): number | undefined {
  let least = Infinity;
  let found: number | undefined;
  places.forEach((place, index) => {
    const now = cost(place);
    if (now >= least) return;
    least = now;
    found = index;
  });
  return found;
}

/** How much the distance beside a direction counts more than that along it. */
const ASIDE = 3;

/** Index of the next place in a direction; undefined at the edge. */
export function nextToward(
  places: readonly Vec2[],
  from: Vec2,
  [dx, dy]: Vec2,
): number | undefined {
  return leastOf(places, ([x, y]) => {
    const along = (x - from[0]) * dx + (y - from[1]) * dy;
    const aside = Math.abs((x - from[0]) * dy - (y - from[1]) * dx);
    return along > 1e-6 && aside <= along ? along + ASIDE * aside : Infinity;
  });
}
