// The obstacle map: the observed area of the workspace. Pure.

import type { SeenMessage } from '../net/protocol.gen';
import type { Vec2 } from './geometry';

/** A cell's state; free is 1, an obstacle 2. */
export const UNKNOWN = 0;

/** State of each cell, row by row from the smallest x and y. */
export function seenCells(seen: Pick<SeenMessage, 'columns' | 'rows' | 'runs'>): Uint8Array {
  const cells = new Uint8Array(seen.columns * seen.rows);
  let cell = 0;
  for (const [state, count] of seen.runs) {
    cells.fill(state, cell, cell + count);
    cell += count;
  }
  return cells;
}

/** Whether the camera has shown a point (in metres). */
export function seenAt(seen: SeenMessage): (point: Vec2) => boolean {
  const { workspace, columns, rows } = seen;
  const cells = seenCells(seen);
  const perX_m = columns / (workspace.x_max_m - workspace.x_min_m);
  const perY_m = rows / (workspace.y_max_m - workspace.y_min_m);
  return ([x_m, y_m]) => {
    // Points on the upper borders belong to the last cells.
    const column = Math.min(columns - 1, Math.floor((x_m - workspace.x_min_m) * perX_m));
    const row = Math.min(rows - 1, Math.floor((y_m - workspace.y_min_m) * perY_m));
    return (cells[row * columns + column] ?? UNKNOWN) !== UNKNOWN;
  };
}
