// |B| and the pull around the magnet, at the height of the bead on the table: colours that fade out, and arrows. Pure.

import { fixed } from '../../ui/format';
import type { Parameters, Plane, PlaneQuery } from '../../net/protocol.gen';
import type { Vec2 } from '../../lab/geometry';
import type { Arrow } from '../../plan/arrows';
import { type Ramp, rampColour } from '../../plan/colourRamp';
import { gridPixels } from '../../plan/pixels';

/** A little more than the magnet's reach. */
const REACH_M = 0.15;
const COUNT = 61;
/** One arrow per this many places, which is 2 cm. */
const EVERY = 4;
const SPACING_M = (2 * REACH_M) / (COUNT - 1);
/** Length of the longest arrow, as a share of the distance between two arrows. */
const LONGEST = 0.9;
/** No arrow below this share of the greatest pull. */
const MIN_PULL = 0.02;
const MAX_ALPHA = 190;

export function planeQuery(parameters: Parameters): PlaneQuery {
  return {
    orientation: parameters.block_orientation,
    lower_face_height_m: parameters.tool_height_m,
    reach_m: REACH_M,
    count: COUNT,
  };
}

export const greatestField_t = ({ field_t }: Plane): number => Math.max(...field_t);

export const greatestPull_n = ({ pull_n }: Plane): number =>
  Math.max(...pull_n.map(([x, y]) => Math.hypot(x, y)));

/** Position of a place relative to the point below the magnet. */
function offsetOf(place: number): Vec2 {
  const along = (index: number): number => index * SPACING_M - REACH_M;
  return [along(place % COUNT), along(Math.floor(place / COUNT))];
}

/** One pixel per place. Weak fields are transparent. */
export function planePixels(plane: Plane, ramp: Ramp): Uint8ClampedArray<ArrayBuffer> {
  const max_t = greatestField_t(plane);
  return gridPixels(COUNT, COUNT, (place) => {
    const share = (plane.field_t[place] ?? 0) / max_t;
    // Round: the corners of the square are too far away.
    const left = 1 - Math.hypot(...offsetOf(place)) / REACH_M;
    const alpha = Math.min(1, Math.max(0, 3 * left)) * Math.sqrt(share) * MAX_ALPHA;
    return [...rampColour(ramp, share), alpha];
  });
}

/** Arrows of the pull on a bead, relative to the point below the magnet. The strongest pull has the longest arrow. */
export function planeArrows(plane: Plane): Arrow[] {
  const max_n = greatestPull_n(plane);
  return plane.pull_n.flatMap(([x_n, y_n], place) => {
    const isDrawn = (place % COUNT) % EVERY === 2 && Math.floor(place / COUNT) % EVERY === 2;
    const [x_m, y_m] = offsetOf(place);
    const share = Math.hypot(x_n, y_n) / max_n;
    if (!isDrawn || share < MIN_PULL || Math.hypot(x_m, y_m) > REACH_M) return [];
    const scale = (LONGEST * EVERY * SPACING_M) / max_n;
    const to_m: Vec2 = [x_m + scale * x_n, y_m + scale * y_n];
    return [{ from_m: [x_m, y_m], to_m, isSeen: true }];
  });
}

/** Corners of the picture relative to the point below the magnet. Each place is in the middle of its pixel. */
export const HALF_SIDE_M = REACH_M + SPACING_M / 2;
export const SIDE_PX = COUNT;

export const fieldWords = (plane: Plane): string => fixed(1000 * greatestField_t(plane), 2);

export const strongestWords = (plane: Plane): string => fixed(1000 * greatestPull_n(plane), 2);
