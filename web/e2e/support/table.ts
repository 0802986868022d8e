// Geometry of the table, in metres.

import type { SceneMessage } from './wire';

export type Point = readonly [number, number];
/** The bead and the goal have a height, which is ignored here. */
export type PointLike = readonly [number, number, ...number[]];

/** The bead cuts corners when it follows the magnet. At this distance from walls it passes. */
const CLEARANCE_M = 0.025;
const STEP_M = 0.01;
const GRID_M = 0.02;

export const distance = (a: PointLike, b: PointLike) => Math.hypot(a[0] - b[0], a[1] - b[1]);

export const flat = ([x, y]: PointLike): Point => [x, y];

export function distanceToSegment(point: PointLike, a: PointLike, b: PointLike) {
  const along: Point = [b[0] - a[0], b[1] - a[1]];
  const share = ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / distance(a, b) ** 2;
  const inside = Math.min(1, Math.max(0, share));
  return distance(point, [a[0] + inside * along[0], a[1] + inside * along[1]]);
}

interface Wall {
  readonly rings: readonly (readonly Point[])[];
  readonly box: readonly [number, number, number, number];
}

const cache = new WeakMap<SceneMessage, readonly Wall[]>();

/** The walls with the rectangles around them, which exclude most points quickly. */
function wallsOf(scene: SceneMessage) {
  const cached = cache.get(scene);
  if (cached) return cached;
  const walls = scene.walls.map(({ exterior, holes }): Wall => {
    const [xs, ys] = [exterior.map(([x]) => x), exterior.map(([, y]) => y)];
    const box = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)] as const;
    return { rings: [exterior, ...holes], box };
  });
  cache.set(scene, walls);
  return walls;
}

/** Whether the rectangle, enlarged by `margin_m`, contains the point. */
const isInBox = ({ box }: Wall, [x, y]: PointLike, margin_m = 0) =>
  x >= box[0] - margin_m &&
  x <= box[1] + margin_m &&
  y >= box[2] - margin_m &&
  y <= box[3] + margin_m;

function isInside(wall: Wall, point: PointLike) {
  if (!isInBox(wall, point)) return false;
  const [x, y] = point;
  let crossings = 0;
  for (const ring of wall.rings) {
    let a = ring.at(-1);
    for (const b of ring) {
      if (a && a[1] > y !== b[1] > y) {
        if (x < a[0] + ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1])) crossings += 1;
      }
      a = b;
    }
  }
  return crossings % 2 === 1;
}

/** Whether a disc of radius CLEARANCE_M at `point` touches neither wall nor border. */
function isClear(scene: SceneMessage, point: PointLike) {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
  const near = wallsOf(scene).filter((wall) => isInBox(wall, point, CLEARANCE_M));
  for (const radius of [0, CLEARANCE_M / 2, CLEARANCE_M]) {
    for (let i = 0; i < 16; i++) {
      const angle = (i * Math.PI) / 8;
      const [x, y] = [point[0] + radius * Math.cos(angle), point[1] + radius * Math.sin(angle)];
      if (x < x_min_m || x > x_max_m || y < y_min_m || y > y_max_m) return false;
      if (near.some((wall) => isInside(wall, [x, y]))) return false;
    }
  }
  return true;
}

/** The share of the straight line from `a` to `b` that is not clear. */
function blockedShare(scene: SceneMessage, a: PointLike, b: PointLike) {
  const steps = Math.ceil(distance(a, b) / STEP_M);
  let blocked = 0;
  for (let i = 1; i <= steps; i++) {
    const share = i / steps;
    const at: Point = [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
    if (!isClear(scene, at)) blocked += 1;
  }
  return blocked / steps;
}

/**
 * Free points at a distance of `min_m` to `max_m` from `from`. Sorted by the blocked share of the
 * straight line from there, then by distance.
 */
export function freePoints(
  scene: SceneMessage,
  from: PointLike,
  min_m: number,
  max_m: number,
): [Point, ...Point[]] {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
  const points: { at: Point; blocked: number; away: number }[] = [];
  for (let x = x_min_m; x <= x_max_m; x += GRID_M) {
    for (let y = y_min_m; y <= y_max_m; y += GRID_M) {
      const away = distance([x, y], from);
      if (away >= min_m && away <= max_m && isClear(scene, [x, y])) {
        points.push({ at: [x, y], blocked: blockedShare(scene, from, [x, y]), away });
      }
    }
  }
  points.sort((a, b) => a.blocked - b.blocked || a.away - b.away);
  const [first, ...others] = points.map(({ at }) => at);
  if (!first) throw new Error(`no free point ${min_m} to ${max_m} m from ${from.join()}`);
  return [first, ...others];
}

/** A point inside a wall, far enough from its edge for a click. */
export function wallPoint(scene: SceneMessage): Point {
  const walls = wallsOf(scene);
  const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
  for (let x = x_min_m + 0.01; x < x_max_m; x += STEP_M) {
    for (let y = y_min_m + 0.01; y < y_max_m; y += STEP_M) {
      const around: Point[] = [
        [x, y],
        [x - 0.004, y],
        [x + 0.004, y],
        [x, y - 0.004],
        [x, y + 0.004],
      ];
      if (walls.some((wall) => around.every((one) => isInside(wall, one)))) return [x, y];
    }
  }
  throw new Error('the map has no wall that a click can hit');
}
