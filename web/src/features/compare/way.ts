// The length of the shortest way to a goal around the walls, on a grid. Pure.

import { insidePolygon, type Vec2 } from '../../lab/geometry';
import type { EventMessage, Polygon, Rect } from '../../net/protocol.gen';

const CELL_M = 0.005;
/** To the eight cells around one: columns, rows. */
const STEPS = [-1, 0, 1].flatMap((column) => [-1, 0, 1].map((row) => [column, row] as const));

/** Lengths in metres; infinite where no way leads from. */
export function waysTo(
  [goalX_m, goalY_m]: Vec2,
  walls: readonly Polygon[],
  { x_min_m, x_max_m, y_min_m, y_max_m }: Rect,
): (from: Vec2) => number {
  const columns = Math.ceil((x_max_m - x_min_m) / CELL_M);
  const rows = Math.ceil((y_max_m - y_min_m) / CELL_M);
  const columnOf = (x_m: number): number => Math.floor((x_m - x_min_m) / CELL_M);
  const rowOf = (y_m: number): number => Math.floor((y_m - y_min_m) / CELL_M);
  const isIn = (column: number, row: number): boolean =>
    column >= 0 && column < columns && row >= 0 && row < rows;
  const lengths_m = new Float64Array(columns * rows).fill(Infinity);
  const isWall = Array.from({ length: columns * rows }, (_, index): boolean => {
    const x_m = x_min_m + ((index % columns) + 0.5) * CELL_M;
    const y_m = y_min_m + (Math.floor(index / columns) + 0.5) * CELL_M;
    return walls.some((wall) => insidePolygon(wall, [x_m, y_m]));
  });
  const [column, row] = [columnOf(goalX_m), rowOf(goalY_m)];
  let front = isIn(column, row) ? [row * columns + column] : [];
  for (const index of front) lengths_m[index] = 0;
  // A cell that has become nearer tells its neighbours, until none becomes nearer.
  while (front.length > 0) {
    const next = new Set<number>();
    for (const index of front) {
      for (const [right, up] of STEPS) {
        const [column, row] = [(index % columns) + right, Math.floor(index / columns) + up];
        const to = row * columns + column;
        if (!isIn(column, row) || isWall[to]) continue;
        const length_m = (lengths_m[index] ?? Infinity) + CELL_M * Math.hypot(right, up);
        if (length_m >= (lengths_m[to] ?? 0) - 1e-9) continue;
        lengths_m[to] = length_m;
        next.add(to);
      }
    }
    front = [...next];
  }
  return ([x_m, y_m]) => {
    const [column, row] = [columnOf(x_m), rowOf(y_m)];
    // The middle of the bead may be in a cell that the wall cuts.
    const around = STEPS.filter(([right, up]) => isIn(column + right, row + up)).map(
      ([right, up]) =>
        (lengths_m[(row + up) * columns + column + right] ?? Infinity) +
        CELL_M * Math.hypot(right, up),
    );
    return Math.min(...around);
  };
}

/** The goal at a tick, by the events of the trial; `first` if none of them is about it. */
export function goalAt(
  marks: readonly EventMessage[],
  tick: number,
  first: Vec2 | undefined,
): Vec2 | undefined {
  const last = marks.findLast(
    (mark) =>
      mark.tick <= tick && (mark.what.code === 'goal_placed' || mark.what.code === 'goal_removed'),
  )?.what;
  if (last?.code === 'goal_placed') return [last.x_m, last.y_m];
  return last ? undefined : first;
}
