// The viewpoints of the scene. Pure except for three's vectors.

import { Vector3 } from 'three';
import type { Rect } from '../net/protocol.gen';
import { floorMargins } from '../plan/floorPicture';
import { cornersOf } from '../lab/geometry';
import { grown } from '../plan/transform';
import type { Point } from './solids';

export const VIEWPOINTS = ['Home', 'Top', 'Front', 'Side'] as const;
export type ViewpointName = (typeof VIEWPOINTS)[number];

export interface Viewpoint {
  /** Point in the middle of the picture. */
  readonly target_m: Point;
  /** Direction from the target to the camera. */
  readonly toCamera: Point;
  /** Box that must be in the picture. */
  readonly bounds_m: readonly Point[];
}

/** Exactly from above the picture would have no defined upper side. */
const ALMOST = 1e-3;
/** Factor of the picture's size over its bounds. */
const ROOM = 1.06;
/** Height of the bounds over the table, except from above: the magnet and its holder. */
const SHOWN_UP_M = 0.26;

const cornersAt = (rect: Rect, z_m: number): Point[] =>
  cornersOf(rect).map(([x_m, y_m]) => [x_m, y_m, z_m]);

export function viewpointOf(name: ViewpointName, workspace: Rect): Viewpoint {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = workspace;
  const [x, y] = [(x_min_m + x_max_m) / 2, (y_min_m + y_max_m) / 2];
  const low = cornersAt(grown(workspace, { ...floorMargins(workspace), top: 0 }), 0);
  const inset = (x_max_m - x_min_m) / 5;
  const narrow = { ...workspace, x_min_m: x_min_m + inset, x_max_m: x_max_m - inset };
  const both = [...low, ...cornersAt(narrow, SHOWN_UP_M)];
  switch (name) {
    case 'Home':
      return { target_m: [x, y + 0.02, 0.06], toCamera: [0.36, -1, 0.85], bounds_m: both };
    case 'Top':
      return { target_m: [x, y, 0], toCamera: [0, -ALMOST, 1], bounds_m: low };
    case 'Front':
      return { target_m: [x, y, SHOWN_UP_M / 2], toCamera: [0, -1, 0.22], bounds_m: both };
    case 'Side':
      return { target_m: [x, y, SHOWN_UP_M / 2], toCamera: [1, 0, 0.22], bounds_m: both };
  }
}

/** Distance from the target to the camera at which all of `bounds_m` is in the picture, with a margin. */
export function distanceFor(viewpoint: Viewpoint, fieldOfView_rad: number, aspect: number): number {
  const back = new Vector3(...viewpoint.toCamera).normalize();
  const right = new Vector3(0, 0, 1).cross(back).normalize();
  const up = new Vector3().crossVectors(back, right);
  const target = new Vector3(...viewpoint.target_m);
  const tangent = Math.tan(fieldOfView_rad / 2) / ROOM;
  const point = new Vector3();
  return viewpoint.bounds_m.reduce((most, bound) => {
    point.set(...bound).sub(target);
    const aside = Math.max(Math.abs(point.dot(up)), Math.abs(point.dot(right)) / aspect);
    return Math.max(most, point.dot(back) + aside / tangent);
  }, 0);
}

/** Table axis of an arrow key, seen from a camera at `azimuth_rad` about the vertical. */
export function turnedArrow(
  arrow: readonly [number, number],
  azimuth_rad: number,
): [number, number] {
  const quarter_rad = Math.round(azimuth_rad / (Math.PI / 2)) * (Math.PI / 2);
  const [cos, sin] = [Math.round(Math.cos(quarter_rad)), Math.round(Math.sin(quarter_rad))];
  return [cos * arrow[0] - sin * arrow[1], sin * arrow[0] + cos * arrow[1]];
}

/** Between these angles from the vertical the arm becomes transparent, because from above it would hide the table. */
const FADED_RAD = 0.3;
const SOLID_RAD = 0.62;
const MIN_OPACITY = 0.16;

export function hidingAt(polar_rad: number): number {
  const share = Math.min(1, Math.max(0, (polar_rad - FADED_RAD) / (SOLID_RAD - FADED_RAD)));
  return MIN_OPACITY + (1 - MIN_OPACITY) * share;
}
