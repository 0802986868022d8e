// The magnet and its holder: the gripper's fingers on the arm, a portal on the planar stage.

import { Group } from 'three';
import { BLOCKS } from '../net/arm.gen';
import type { Orientation, Rect } from '../net/protocol.gen';
import type { Paints } from './paints';
import { type Point, Solids } from './solids';
import { RIM_M } from './tray';

/** The halves at either pole, around the block's own middle above the tool point. */
function halvesOf({ size_m: [x, y, z], along }: (typeof BLOCKS)[Orientation]) {
  const at = (side: number): Point =>
    along === 0 ? [(side * x) / 4, 0, z / 2] : [0, 0, z / 2 + (side * z) / 4];
  const size_m: Point = along === 0 ? [x / 2, y, z] : [x, y, z / 2];
  return { size_m, north_m: at(1), south_m: at(-1) };
}

const FINGER_M = 0.011;
const PAD_M = 0.004;
/** From the tool point up to the gripper's knuckles. */
const KNUCKLES_M = 0.082;

/** Two fingers that hold the block across its narrower side. */
function fingers(solids: Solids, [x, y, z]: Point): void {
  const acrossX = x < y;
  const across_m = acrossX ? x : y;
  const placed = (across: number, wide: number, up: number): Point =>
    acrossX ? [across, wide, up] : [wide, across, up];
  const wide_m = across_m + 2 * (FINGER_M + PAD_M) + 0.01;
  solids.box('gripper', [0, 0, KNUCKLES_M], placed(wide_m, 0.032, 0.026));
  solids.tube('gripper', { origin: [0, 0, 0], along: [0, 0, 1] }, [KNUCKLES_M, 0.095], 0.02);
  // Fingers reach from the knuckles to the block's lower edge, with a pad at its side.
  const low_m = 0.1 * z;
  for (const side of [-0.5, 0.5]) {
    const finger_m = side * (across_m + 2 * PAD_M + FINGER_M);
    const middle_m = (low_m + KNUCKLES_M) / 2;
    solids.box(
      'gripper',
      placed(finger_m, 0, middle_m),
      placed(FINGER_M, 0.018, KNUCKLES_M - low_m),
    );
    const pad_m = side * (across_m + PAD_M);
    solids.box('arm-seam', placed(pad_m, 0, z / 2 + 0.006), placed(PAD_M, 0.021, z + 0.008));
  }
}

const RAIL_M = 0.012;
/** From the workspace to the middle of a rail. */
const BESIDE_M = RIM_M + 0.018;
/** From the table to the middle of the portal's beam. */
const BEAM_UP_M = 0.235;
/** Upper end of the column above the tool point. */
const COLUMN_M = 0.24;

/** The parts of the planar stage: rails beside the table, a portal on the rails, a carriage with a column. */
class Portal {
  readonly group = new Group();
  private readonly bridge: Group;
  private readonly carriage: Group;
  private readonly column: Group;

  constructor(paints: Paints, workspace: Rect, block_m: number) {
    const { x_min_m, x_max_m, y_min_m, y_max_m } = workspace;
    const rails_m = [y_min_m - BESIDE_M, y_max_m + BESIDE_M] as const;
    const middle_m = (rails_m[0] + rails_m[1]) / 2;
    const span_m = rails_m[1] - rails_m[0];
    const length_m = x_max_m - x_min_m + 0.03;
    const rails = new Solids();
    const bridge = new Solids().box('arm', [0, middle_m, BEAM_UP_M], [0.024, span_m, 0.03]);
    for (const y of rails_m) {
      rails.box('gripper', [(x_min_m + x_max_m) / 2, y, RAIL_M / 2], [length_m, 0.016, RAIL_M]);
      bridge.box('arm-seam', [0, y, RAIL_M + 0.009], [0.05, 0.024, 0.018]);
      bridge.box('arm', [0, y, (BEAM_UP_M + RAIL_M) / 2], [0.024, 0.016, BEAM_UP_M - RAIL_M]);
    }
    const upright = { origin: [0, 0, 0], along: [0, 0, 1] } as const;
    this.bridge = bridge.group(paints);
    this.carriage = new Solids()
      .box('arm-lid', [0, 0, BEAM_UP_M], [0.05, 0.05, 0.046])
      .group(paints);
    this.column = new Solids()
      .tube('arm', upright, [block_m + 0.02, COLUMN_M], 0.009)
      .tube('gripper', upright, [block_m, block_m + 0.02], 0.016, 0.012)
      .group(paints);
    this.carriage.add(this.column);
    this.bridge.add(this.carriage);
    this.group.add(rails.group(paints), this.bridge);
  }

  place([x, y, z]: Point): void {
    this.bridge.position.x = x;
    this.carriage.position.y = y;
    this.column.position.z = z;
  }
}

export class Tool {
  readonly group = new Group();
  private readonly held: Group;
  private readonly portal: Portal | undefined;

  /** On the planar stage over `portalOver`, otherwise on the arm. */
  constructor(paints: Paints, orientation: Orientation, portalOver: Rect | undefined) {
    const block = BLOCKS[orientation];
    const halves = halvesOf(block);
    const solids = new Solids()
      .box('north', halves.north_m, halves.size_m)
      .box('south', halves.south_m, halves.size_m);
    if (!portalOver) fingers(solids, block.size_m);
    this.held = solids.group(paints);
    this.group.add(this.held);
    if (portalOver) {
      this.portal = new Portal(paints, portalOver, block.size_m[2]);
      this.group.add(this.portal.group);
    }
  }

  /** At the tool point, which is the middle of the block's lower face. */
  place(at: Point, turn_rad: number): void {
    this.held.position.set(...at);
    this.held.rotation.z = turn_rad;
    this.portal?.place(at);
  }
}
