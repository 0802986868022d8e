// Start and goal on the drawing: whether a bead can be there, and what they are for the server. Pure.

import { distanceToLine, insidePolygon, type Vec2 } from '../../lab/geometry';
import type { MapCheck, Rect } from '../../net/protocol.gen';
import type { Mark, Marks, Mm } from './drawing';

/** Radius of the bead. */
const ROOM_M = 0.0025;

const NAMES: readonly (readonly [Mark, string])[] = [
  ['start', 'The start'],
  ['goal', 'The goal'],
];

const inMetres = ([x, y]: Mm): Vec2 => [x / 1000, 0 - y / 1000];

function hasRoom([x, y]: Vec2, workspace: Rect, outlines: MapCheck['outlines']): boolean {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = workspace;
  const inside_m = Math.min(x - x_min_m, x_max_m - x, y - y_min_m, y_max_m - y);
  const isFree = outlines.every(
    (wall) =>
      !insidePolygon(wall, [x, y]) &&
      [wall.exterior, ...wall.holes].every((ring) =>
        ring.every((to, index) => distanceToLine([x, y], ring.at(index - 1) ?? to, to) >= ROOM_M),
      ),
  );
  return inside_m >= ROOM_M && isFree;
}

/** One sentence for each mark where a wall is. */
export function markFaults(
  marks: Marks,
  { workspace, outlines }: Pick<MapCheck, 'workspace' | 'outlines'>,
): string[] {
  return NAMES.flatMap(([mark, name]) => {
    const at = marks[mark];
    const isWrong = at && !hasRoom(inMetres(at), workspace, outlines);
    return isWrong ? [`${name} is in a wall: place it elsewhere.`] : [];
  });
}

/** Start and goal of the trial, in metres. */
export interface Places {
  readonly start_m?: [number, number];
  readonly goal_m?: [number, number];
}

export function placesOf({ start, goal }: Marks): Places {
  const place = (at: Mm): [number, number] => {
    const [x, y] = inMetres(at);
    return [x, y];
  };
  return { ...(start && { start_m: place(start) }), ...(goal && { goal_m: place(goal) }) };
}
