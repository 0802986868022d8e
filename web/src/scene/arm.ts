// The UR5: its solids, each rigid in the frame of one link, so a pose is six matrices.

import { Group, Matrix4 } from 'three';
import { ARM_SOLIDS, TOOL_LENGTH_M } from '../net/arm.gen';
import { linkFrames, toolTurn } from './kinematics';
import type { Paints } from './paints';
import { type Line, Solids } from './solids';

const PAINTS = { metal: 'arm', lid: 'arm-lid', seam: 'arm-seam', foot: 'gripper' } as const;

/** The solids fixed to a frame: 0 is the base, 6 the flange. */
function solidsOf(frame: number): Solids {
  const solids = new Solids();
  for (const solid of ARM_SOLIDS) {
    if (solid.frame !== frame) continue;
    const line = { origin: solid.origin_m, along: solid.along };
    solids[solid.shape](PAINTS[solid.material], line, solid.places_m, solid.radius_m);
  }
  return solids;
}

/** The gripper's body; its fingers are upright with the block. */
function gripper(): Solids {
  const axis: Line = { origin: [0, 0, 0], along: [0, 0, 1] };
  return new Solids()
    .tube('arm-seam', axis, [0, 0.08 * TOOL_LENGTH_M], 0.0375)
    .tube('arm', axis, [0.08 * TOOL_LENGTH_M, 0.12 * TOOL_LENGTH_M], 0.035)
    .tube('gripper', axis, [0.12 * TOOL_LENGTH_M, 0.44 * TOOL_LENGTH_M], 0.034)
    .tube('gripper', axis, [0.44 * TOOL_LENGTH_M, 0.5 * TOOL_LENGTH_M], 0.034, 0.026);
}

/** What hides the table when one looks from above, and fades then. */
export const HIDING = ['arm', 'arm-lid', 'arm-seam', 'gripper'] as const;

export class Arm {
  readonly group = new Group();
  private readonly frames: Matrix4[] = [];

  constructor(paints: Paints) {
    this.group.add(solidsOf(0).group(paints));

    for (const solids of [...[1, 2, 3, 4, 5].map(solidsOf), gripper()]) {
      const link = solids.group(paints);
      link.matrixAutoUpdate = false;
      this.frames.push(link.matrix);
      this.group.add(link);
    }
  }

  /** Returns how far the tool is turned about the vertical. */
  pose(joints_rad: readonly number[]): number {
    linkFrames(joints_rad, this.frames);
    for (const link of this.group.children) link.matrixWorldNeedsUpdate = true;
    const flange = this.frames[5];
    return flange ? toolTurn(flange) : 0;
  }
}
