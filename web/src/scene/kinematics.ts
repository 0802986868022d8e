// Where the links of the UR5 are, from its joint angles; as server/core/robot/forward.rs.

import { Matrix4 } from 'three';
import { DH } from '../net/arm.gen';

const link = new Matrix4();

/**
 * Writes the poses `base_from_frame` of the frames 1 to 6 into `frames`. Frame i is fixed to link i
 * and lies at its far end; frame 6 is the flange.
 */
export function linkFrames(joints_rad: readonly number[], frames: readonly Matrix4[]): void {
  let before: Matrix4 | undefined;
  DH.forEach(([d_m, a_m, alpha], i) => {
    const frame = frames[i];
    if (!frame) return;
    const theta_rad = joints_rad[i] ?? 0;
    const [sin, cos] = [Math.sin(theta_rad), Math.cos(theta_rad)];
    // Of a twist in quarter turns: its cosine and its sine.
    const [twistCos, twistSin] = [alpha === 0 ? 1 : 0, alpha];
    // Rz(θ)·Tz(d)·Tx(a)·Rx(α), row by row.
    // prettier-ignore
    link.set(
      cos, -sin * twistCos, sin * twistSin, a_m * cos,
      sin, cos * twistCos, -cos * twistSin, a_m * sin,
      0, twistSin, twistCos, d_m,
      0, 0, 0, 1,
    );
    if (before) frame.multiplyMatrices(before, link);
    else frame.copy(link);
    before = frame;
  });
}

/** How far a tool that points down is turned about the vertical, from the pose of its flange. */
export function toolTurn(flange: Matrix4): number {
  // Not turned, the flange's x axis points along −y of the base.
  const [x, y] = flange.elements;
  return Math.atan2(x, -y);
}
