// Measures of the tray. It is drawn higher than the walls of the plant, to look like the tissue of the map.

import type { Rect } from '../net/protocol.gen';

export const TRAY_UP_M = 0.025;
/** Of the upper edges. */
export const BEVEL_M = 0.003;
/** Of the rim around the workspace. */
export const RIM_M = 0.014;
/** Of its corners. */
const CORNER_M = 0.016;
/** Pieces of a corner. */
const CORNER_PIECES = 10;

/** Counterclockwise. */
export function roundedRect(rect: Rect, radius_m = CORNER_M): [number, number][] {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = rect;
  const pieces = radius_m > 0 ? CORNER_PIECES : 0;
  const corner = (x: number, y: number, from: number): [number, number][] =>
    Array.from({ length: pieces + 1 }, (_, i) => {
      const angle = ((from + (pieces && i / pieces)) * Math.PI) / 2;
      return [x + radius_m * Math.cos(angle), y + radius_m * Math.sin(angle)];
    });
  return [
    ...corner(x_max_m - radius_m, y_min_m + radius_m, -1),
    ...corner(x_max_m - radius_m, y_max_m - radius_m, 0),
    ...corner(x_min_m + radius_m, y_max_m - radius_m, 1),
    ...corner(x_min_m + radius_m, y_min_m + radius_m, 2),
  ];
}
