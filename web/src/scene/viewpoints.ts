// The viewpoints of the scene. Pure except for three's vectors.

import { Vector3 } from 'three';
import { cornersOf } from '../lab/geometry';
import type { Rect } from '../net/protocol.gen';
import { grown } from '../plan/transform';
import { type Ball, reachOf } from './reach';
import type { Point } from './solids';
import { RIM_M, TRAY_UP_M } from './tray';

export const VIEWPOINTS = ['Home', 'Top', 'Front', 'Side'] as const;
export type ViewpointName = (typeof VIEWPOINTS)[number];

/** What must be in the picture. */
export interface Stage {
  readonly tray: readonly Ball[];
  /** The arm in all its poses, or the portal. */
  readonly holder: readonly Ball[];
}

/** A camera: the point in the middle of its picture, and where it is, seen from there. */
export interface Seat {
  readonly target_m: Point;
  readonly toCamera_m: Point;
}

/** The picture that a stage is fitted into. */
export interface Lens {
  /** Of the vertical field of view's half. */
  readonly tangent: number;
  readonly aspect: number;
  /** Shift of the picture to the right, as a share of its width. */
  readonly shift: number;
  /** Share of its height that stays free below. */
  readonly below?: number;
}

/** Factor of the picture's size over what is in it. */
const ROOM = 1.04;
/** Upper end of a portal over its lowest tool point. */
const PORTAL_UP_M = 0.4;
/** From the workspace to the outer side of a portal's rails. */
const PORTAL_BESIDE_M = 0.045;
const DEGREE = Math.PI / 180;

/** A direction to the camera: from the front to the left, and above the table. */
function toward(left_deg: number, up_deg: number): Point {
  const [left, up] = [left_deg * DEGREE, up_deg * DEGREE];
  return [-Math.sin(left) * Math.cos(up), -Math.cos(left) * Math.cos(up), Math.sin(up)];
}

const DIRECTIONS: Record<ViewpointName, Point> = {
  Home: toward(13, 48),
  // Exactly from above the picture would have no defined upper side.
  Top: toward(0, 89.95),
  Front: toward(0, 15),
  Side: toward(-90, 15),
};

const pointsAt = (rect: Rect, z_m: number): Ball[] =>
  cornersOf(rect).map(([x_m, y_m]) => ({ at: new Vector3(x_m, y_m, z_m), radius_m: 0 }));
const widened = (rect: Rect, by_m: number): Rect =>
  grown(rect, { left: by_m, right: by_m, top: by_m, bottom: by_m });

export function stageOf(workspace: Rect, hasArm: boolean): Stage {
  const tray = widened(workspace, RIM_M);
  const rails = widened(workspace, PORTAL_BESIDE_M);
  const portal = [...pointsAt(rails, 0), ...pointsAt(workspace, PORTAL_UP_M)];
  return {
    tray: [...pointsAt(tray, 0), ...pointsAt(tray, TRAY_UP_M)],
    holder: hasArm ? reachOf(workspace) : portal,
  };
}

/** Farthest that a stage reaches along the sides of a view cone with this tangent. */
function reach(balls: readonly Ball[], side: Vector3, back: Vector3, tangent: number): number {
  const cone = side.clone().addScaledVector(back, tangent);
  const slant = cone.length();
  return balls.reduce(
    (most, { at, radius_m }) => Math.max(most, at.dot(cone) + radius_m * slant),
    -Infinity,
  );
}

/** The nearest camera in a direction that has the whole stage in its picture. */
export function seatOf(name: ViewpointName, stage: Stage, lens: Lens): Seat {
  const { tangent, aspect, shift, below = 0 } = lens;
  const back = new Vector3(...DIRECTIONS[name]);
  const right = new Vector3(0, 0, 1).cross(back).normalize();
  const up = new Vector3().crossVectors(back, right);
  const balls = name === 'Top' ? stage.tray : [...stage.tray, ...stage.holder];
  const high = tangent / ROOM;
  const wide = (tangent * aspect * (1 - 2 * Math.abs(shift))) / ROOM;
  const spans = [
    [right, wide, wide],
    [up, high, high * (1 - 2 * below)],
  ] as const;
  // Per side: what the stage needs toward it and toward the other one.
  const fits = spans.map(([side, toSide, toOther]) => ({
    side,
    slant: toSide - toOther,
    more: reach(balls, side, back, toSide),
    less: reach(balls, side.clone().negate(), back, toOther),
    slopes: toSide + toOther,
  }));
  const far = Math.max(...fits.map(({ more, less, slopes }) => (more + less) / slopes));
  const camera = back.clone().multiplyScalar(far);
  for (const { side, more, less, slant } of fits)
    camera.addScaledVector(side, (more - less - slant * far) / 2);
  // The target is on the view's axis, beside the middle of the tray.
  const middle = stage.tray
    .reduce((sum, { at }) => sum.add(at), new Vector3())
    .divideScalar(stage.tray.length);
  const toCamera = back.multiplyScalar(camera.clone().sub(middle).dot(back));
  return { target_m: camera.sub(toCamera).toArray(), toCamera_m: toCamera.toArray() };
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
const FADED_RAD = 0.2;
const SOLID_RAD = 0.55;
const MIN_OPACITY = 0.14;

export function hidingAt(polar_rad: number): number {
  const share = Math.min(1, Math.max(0, (polar_rad - FADED_RAD) / (SOLID_RAD - FADED_RAD)));
  return MIN_OPACITY + (1 - MIN_OPACITY) * share;
}
