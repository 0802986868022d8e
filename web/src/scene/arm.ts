// The UR5: housings around its joints and limbs between them, after server/camera/arm.rs.
//
// Every solid is rigid in the frame of one link, so a pose is six matrices.

import { Group, Matrix4 } from 'three';
import { FOREARM_M, linkFrames, UPPER_ARM_M, WRIST_LENGTHS_M } from './kinematics';
import type { Paints } from './paints';
import { type Line, type Point, Solids } from './solids';

/** Along the shoulder's axis, from the joint frames' plane to the middle of the upper arm. */
const UPPER_ARM_ASIDE_M = 0.1358;
/** The same for the forearm. */
const FOREARM_ASIDE_M = 0.0165;
const SHOULDER_M = 0.089159;
/** Of the housings around the joints: the first two, the elbow, the wrists. */
const SHOULDER_RADIUS_M = 0.06;
const ELBOW_RADIUS_M = 0.051;
const WRIST_RADIUS_M = 0.0405;
/** Width of the dark ring between two housings. */
const SEAM_M = 0.006;
/** From the flange to the tool point. */
const TOOL_LENGTH_M = 0.18;

/** A joint turns about the z of the frame before it. */
const AXIS: Line = { origin: [0, 0, 0], along: [0, 0, 1] };

/** Around a joint, between two places on its axis: the first carries a lid, the second meets the next housing. */
function housing(
  solids: Solids,
  [closed, open]: readonly [number, number],
  radius_m: number,
): void {
  const out = Math.sign(closed - open);
  solids
    .tube('arm', AXIS, [open, closed], radius_m)
    .tube('arm-seam', AXIS, [open - out * SEAM_M, open], 0.95 * radius_m)
    .tube('arm-seam', AXIS, [closed, closed + out * 0.003], 0.94 * radius_m)
    .tube('arm-lid', AXIS, [closed + out * 0.003, closed + out * 0.01], 0.97 * radius_m)
    .tube(
      'arm-lid',
      AXIS,
      [closed + out * 0.01, closed + out * 0.018],
      0.97 * radius_m,
      0.72 * radius_m,
    );
}

/** A tube of `length_m` toward the frame's origin, which ends in stubs, at `aside_m` along the joint's axis. */
function limb(
  solids: Solids,
  length_m: number,
  aside_m: number,
  stubRadii_m: readonly [number, number],
  stubs_m: readonly [number, number],
  radius_m: number,
): void {
  const far: Point = [length_m, 0, aside_m];
  const near: Point = [0, 0, aside_m];
  solids.tube('arm', { origin: far, along: [-1, 0, 0] }, [0, length_m], radius_m);
  const ends: [Line, number, number][] = [
    [{ origin: far, along: [-1, 0, 0] }, stubRadii_m[0], stubs_m[0]],
    [{ origin: near, along: [1, 0, 0] }, stubRadii_m[1], stubs_m[1]],
  ];
  for (const [line, stubRadius_m, stub_m] of ends) {
    solids
      .tube('arm', line, [0, stub_m], stubRadius_m)
      .tube('arm', line, [stub_m, stub_m + 0.012], stubRadius_m, radius_m)
      .tube('arm-seam', line, [stub_m + 0.012, stub_m + 0.02], radius_m + 0.0012);
  }
}

function foot(): Solids {
  return new Solids()
    .tube('gripper', AXIS, [0, 0.01], 0.086)
    .tube('arm', AXIS, [0.01, 0.034], 0.072)
    .tube('arm-seam', AXIS, [0.034, 0.034 + SEAM_M], 0.069)
    .tube('arm', AXIS, [0.034 + SEAM_M, SHOULDER_M], 0.0625);
}

/** The solids of each link, in its own frame. */
function links(): Solids[] {
  const all = Array.from({ length: 6 }, () => new Solids()) as [
    Solids,
    Solids,
    Solids,
    Solids,
    Solids,
    Solids,
  ];
  const [shoulder, upperArm, forearm, wrist1, wrist2, wrist3] = all;
  housing(shoulder, [-0.062, UPPER_ARM_ASIDE_M - 0.062], SHOULDER_RADIUS_M);
  housing(shoulder, [UPPER_ARM_ASIDE_M + 0.052, UPPER_ARM_ASIDE_M - 0.058], SHOULDER_RADIUS_M);

  housing(upperArm, [UPPER_ARM_ASIDE_M + 0.046, UPPER_ARM_ASIDE_M - 0.05], ELBOW_RADIUS_M);
  limb(upperArm, UPPER_ARM_M, UPPER_ARM_ASIDE_M, [0.054, 0.047], [0.088, 0.076], 0.043);
  housing(upperArm, [FOREARM_ASIDE_M - 0.044, UPPER_ARM_ASIDE_M - 0.056], ELBOW_RADIUS_M);

  limb(forearm, FOREARM_M, FOREARM_ASIDE_M, [0.046, 0.037], [0.076, 0.06], 0.036);
  housing(forearm, [FOREARM_ASIDE_M - 0.034, 0.062], WRIST_RADIUS_M);

  // Three wrists; each ends in the side of the next.
  const [toWrist2_m, toWrist3_m, toFlange_m] = WRIST_LENGTHS_M;
  forearm.tube('arm', AXIS, [0.5 * toWrist2_m, toWrist2_m], 0.036);
  wrist1.tube('arm', AXIS, [0.5 * toWrist3_m, toWrist3_m], 0.036);
  for (const wrist of [wrist1, wrist2]) housing(wrist, [-0.04, 0.047], WRIST_RADIUS_M);
  wrist2.tube('arm', AXIS, [0.047, toFlange_m], 0.0365);

  // The gripper's body; its fingers are upright with the block.
  wrist3
    .tube('arm-seam', AXIS, [0, 0.08 * TOOL_LENGTH_M], 0.0375)
    .tube('arm', AXIS, [0.08 * TOOL_LENGTH_M, 0.12 * TOOL_LENGTH_M], 0.035)
    .tube('gripper', AXIS, [0.12 * TOOL_LENGTH_M, 0.44 * TOOL_LENGTH_M], 0.034)
    .tube('gripper', AXIS, [0.44 * TOOL_LENGTH_M, 0.5 * TOOL_LENGTH_M], 0.034, 0.026);
  return all;
}

/** What hides the table when one looks from above, and fades then. */
export const HIDING = ['arm', 'arm-lid', 'arm-seam', 'gripper'] as const;

export class Arm {
  readonly group = new Group();
  private readonly frames: Matrix4[] = [];

  constructor(paints: Paints) {
    this.group.add(foot().group(paints));

    for (const solids of links()) {
      const link = solids.group(paints);
      link.matrixAutoUpdate = false;
      this.frames.push(link.matrix);
      this.group.add(link);
    }
  }

  pose(joints_rad: readonly number[]): void {
    linkFrames(joints_rad, this.frames);
    for (const link of this.group.children) link.matrixWorldNeedsUpdate = true;
  }
}
