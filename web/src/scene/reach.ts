// Where the arm can be: its joint angles above a place of the workspace, and balls around its solids in all those poses.

import { Matrix4, Vector3 } from 'three';
import { ARM_SOLIDS, DH, TOOL_LENGTH_M } from '../net/arm.gen';
import type { Rect } from '../net/protocol.gen';
import { linkFrames } from './kinematics';
import type { Point } from './solids';

/** A ball that must be in the picture. */
export interface Ball {
  readonly at: Vector3;
  readonly radius_m: number;
}

/** The tool heights that can be set, from the table to the tool point. */
const TOOL_HEIGHTS_M = [0.09, 0.2] as const;
/** Places along each side of the workspace. */
const PLACES = 9;

/**
 * The joint angles with the tool point at a place, the tool pointing down and not turned, the elbow up, as the server
 * moves the arm. Undefined if the arm cannot reach it.
 */
export function jointsAt([x, y, z]: Point): number[] | undefined {
  const [[d1], [, a2], [, a3], [d4], [d5], [d6]] = DH;
  const out_m = Math.sqrt(x * x + y * y - d4 * d4);
  const turn = Math.atan2(y, x) + Math.atan2(d4, out_m);
  // Wrist 1 from the shoulder, in the vertical plane of the upper arm.
  const across_m = out_m - d5;
  const up_m = z + TOOL_LENGTH_M + d6 - d1;
  const far_m = Math.hypot(across_m, up_m);
  const lift =
    Math.atan2(up_m, across_m) + Math.acos((a2 * a2 + far_m * far_m - a3 * a3) / (-2 * a2 * far_m));
  const fore = Math.atan2(up_m + a2 * Math.sin(lift), across_m + a2 * Math.cos(lift));
  if (Number.isNaN(lift)) return undefined;
  const wrist = -fore - Math.PI / 2;
  return [turn, lift - Math.PI, fore - lift, wrist, Math.PI / 2, turn];
}

/** The solids of the arm in a pose, as balls around their ends. */
export function* ballsAt(
  joints_rad: readonly number[],
  frames: readonly Matrix4[],
): Generator<Ball> {
  linkFrames(joints_rad, frames);
  for (const { frame, origin_m, along, places_m, radius_m } of ARM_SOLIDS) {
    for (const place_m of places_m) {
      const at = new Vector3(...along).multiplyScalar(place_m).add(new Vector3(...origin_m));
      const base = frames[frame - 1];
      yield { at: base ? at.applyMatrix4(base) : at, radius_m };
    }
  }
}

/** The arm in all poses above the workspace. */
export function reachOf({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): Ball[] {
  const frames = Array.from({ length: 6 }, () => new Matrix4());
  const balls: Ball[] = [];
  for (let i = 0; i < PLACES * PLACES; i++) {
    const [column, row] = [(i % PLACES) / (PLACES - 1), Math.floor(i / PLACES) / (PLACES - 1)];
    const x = x_min_m + column * (x_max_m - x_min_m);
    const y = y_min_m + row * (y_max_m - y_min_m);
    for (const z of TOOL_HEIGHTS_M) {
      const joints_rad = jointsAt([x, y, z]);
      if (joints_rad) balls.push(...ballsAt(joints_rad, frames));
    }
  }
  return balls;
}
