// A goal for a map that has none: the place with the longest way from the bead. Pure.

import { distance, distanceToLine, insidePolygon, type Vec2 } from '../../lab/geometry';
import { GOAL_RADIUS_M, type Polygon, type Rect } from '../../net/protocol.gen';

const STEP_M = 0.01;
/** From walls and border; half the narrowest channel in which the controllers are tested. */
const ROOM_M = 0.0175;
/** From the border, so that the mark of the goal is whole. */
const GOAL_ROOM_M = 1.2 * GOAL_RADIUS_M;

const isClearOf =
  (at: Vec2) =>
  (wall: Polygon): boolean =>
    !insidePolygon(wall, at) &&
    [wall.exterior, ...wall.holes].every((ring) =>
      ring.every((to, index) => distanceToLine(at, ring.at(index - 1) ?? to, to) >= ROOM_M),
    );

/** Undefined if there is no room. */
export function farGoal(
  { workspace, walls }: { readonly workspace: Rect; readonly walls: readonly Polygon[] },
  bead: Vec2,
): Vec2 | undefined {
  const columns = Math.floor((workspace.x_max_m - workspace.x_min_m - 2 * ROOM_M) / STEP_M) + 1;
  const rows = Math.floor((workspace.y_max_m - workspace.y_min_m - 2 * ROOM_M) / STEP_M) + 1;
  const place = (cell: number): Vec2 => [
    workspace.x_min_m + ROOM_M + (cell % columns) * STEP_M,
    workspace.y_min_m + ROOM_M + Math.floor(cell / columns) * STEP_M,
  ];
  const free = new Set<number>();
  for (let cell = 0; cell < columns * rows; cell += 1) {
    if (walls.every(isClearOf(place(cell)))) free.add(cell);
  }
  let first: number | undefined;
  for (const cell of free) {
    const isNearer =
      first === undefined || distance(place(cell), bead) < distance(place(first), bead);
    if (isNearer) first = cell;
  }
  if (first === undefined) return undefined;
  // Breadth first: the last one that is reached is the farthest.
  free.delete(first);
  const reached = [first];
  for (const cell of reached) {
    const column = cell % columns;
    const sides = [column > 0 ? cell - 1 : -1, column < columns - 1 ? cell + 1 : -1];
    for (const next of [...sides, cell - columns, cell + columns]) {
      if (free.delete(next)) reached.push(next);
    }
  }
  const isInside = (cell: number): boolean => {
    const [x, y] = place(cell);
    const [left, right] = [x - workspace.x_min_m, workspace.x_max_m - x];
    return Math.min(left, right, y - workspace.y_min_m, workspace.y_max_m - y) > GOAL_ROOM_M;
  };
  const last = reached.findLast(isInside) ?? reached.at(-1);
  return last === undefined || last === first ? undefined : place(last);
}
