// How many trials a recovery map has. Pure.

import { insidePolygon, type Vec2 } from '../../lab/geometry';
import type { RecoveryKind, SceneMessage } from '../../net/protocol.gen';

/** Cells of the finest grid, as `server/lab/recovery` makes them. Of places, a few of these have no room for the bead. */
export function cellsMost(
  kind: RecoveryKind,
  columns: number,
  { workspace, walls }: Pick<SceneMessage, 'workspace' | 'walls'>,
): number {
  if (kind !== 'place') return columns * Math.max(4, Math.floor(columns / 4));
  const { x_min_m, x_max_m, y_min_m, y_max_m } = workspace;
  const size_m = (x_max_m - x_min_m) / columns;
  const rows = Math.floor((y_max_m - y_min_m) / size_m + 1e-9);
  const centers = Array.from({ length: columns * rows }, (_, cell): Vec2 => [
    x_min_m + ((cell % columns) + 0.5) * size_m,
    y_min_m + (Math.floor(cell / columns) + 0.5) * size_m,
  ]);
  return centers.filter((at) => !walls.some((wall) => insidePolygon(wall, at))).length;
}
