// Geometry of the table, in metres.

import type { SceneMessage } from './wire';

export type Point = readonly [number, number];
/** The bead and the goal have a height, which does not matter here. */
export type PointLike = readonly [number, number, ...number[]];

/** A bead behind its magnet cuts corners; farther from walls than this, it passes. */
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

function crosses(a: Point, b: Point, [x, y]: PointLike) {
  const isAcross = a[1] > y !== b[1] > y;
  return isAcross && x < a[0] + ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1]);
}

function insideWall(scene: SceneMessage, point: PointLike) {
  return scene.walls.some(({ exterior, holes }) => {
    const edges = [exterior, ...holes].flatMap((ring) =>
      ring.map((a, i) => [a, ring[(i + 1) % ring.length] ?? a] as const),
    );
    return edges.filter(([a, b]) => crosses(a, b, point)).length % 2 === 1;
  });
}

/** Whether a disc of CLEARANCE_M at `point` touches neither wall nor border. */
function isClear(scene: SceneMessage, point: PointLike) {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
  for (const radius of [0, CLEARANCE_M / 2, CLEARANCE_M]) {
    for (let i = 0; i < 16; i++) {
      const angle = (i * Math.PI) / 8;
      const [x, y] = [point[0] + radius * Math.cos(angle), point[1] + radius * Math.sin(angle)];
      if (x < x_min_m || x > x_max_m || y < y_min_m || y > y_max_m) return false;
      if (insideWall(scene, [x, y])) return false;
    }
  }
  return true;
}

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

/** Free points `least_m` to `most_m` from `from`; first those with the shortest free straight line to it. */
export function freePoints(
  scene: SceneMessage,
  from: PointLike,
  least_m: number,
  most_m: number,
): [Point, ...Point[]] {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
  const points: { at: Point; blocked: number; away: number }[] = [];
  for (let x = x_min_m; x <= x_max_m; x += GRID_M) {
    for (let y = y_min_m; y <= y_max_m; y += GRID_M) {
      const away = distance([x, y], from);
      if (away >= least_m && away <= most_m && isClear(scene, [x, y])) {
        points.push({ at: [x, y], blocked: blockedShare(scene, from, [x, y]), away });
      }
    }
  }
  points.sort((a, b) => a.blocked - b.blocked || a.away - b.away);
  const [first, ...others] = points.map(({ at }) => at);
  if (!first) throw new Error(`no free point ${least_m} to ${most_m} m from ${from.join()}`);
  return [first, ...others];
}

/** The middle of a wall that a click can hit. */
export function wallPoint(scene: SceneMessage): Point {
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
      if (around.every((point) => insideWall(scene, point))) return [x, y];
    }
  }
  throw new Error('the map has no wall inside');
}
