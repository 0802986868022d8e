// The UR5: its solids, each rigid in the frame of one link, so a pose is six matrices.

import {
  BackSide,
  Group,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Vector3,
  type BufferGeometry,
} from 'three';
import { mergeGeometries, mergeVertices } from 'three/addons/utils/BufferGeometryUtils.js';
import { ARM_SOLIDS, TOOL_LENGTH_M } from '../net/arm.gen';
import { type Rod, covers, faded, isSettled, SOLID } from './fading';
import { linkFrames, toolTurn } from './kinematics';
import type { Paints } from './paints';
import { type Line, Solids } from './solids';

const PAINTS = { metal: 'arm', lid: 'arm-lid', seam: 'arm-seam', foot: 'arm-seam' } as const;
/** Width of the outline of a transparent link. */
const OUTLINE_M = 0.0016;
/** Drawing order in a transparent link: its depth, so that only its nearest surface shows; its outline; itself. */
const FADED_ORDER = { depth: 1, outline: 2, surface: 3 } as const;

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

/** The same surface a little larger. */
function grown(geometry: BufferGeometry): BufferGeometry {
  geometry.deleteAttribute('normal').deleteAttribute('uv');
  const whole = mergeVertices(geometry);
  whole.computeVertexNormals();
  const { position, normal } = whole.attributes;
  if (!position || !normal) return whole;
  for (let i = 0; i < position.count; i++) {
    const [x, y, z] = [position.getX(i), position.getY(i), position.getZ(i)];
    const grow = (at: number, by: number): number => at + OUTLINE_M * by;
    position.setXYZ(i, grow(x, normal.getX(i)), grow(y, normal.getY(i)), grow(z, normal.getZ(i)));
  }
  return whole;
}

class Link {
  readonly group: Group;
  /** Of the links that may become transparent when they cover something. */
  private readonly rods: Rod[] = [];
  private readonly rodsNow: Rod[] = [];
  private fade = SOLID;
  private readonly surfaces: readonly Mesh[];
  private readonly others: readonly Mesh[];

  constructor(
    private readonly paints: Paints,
    private readonly frame: number,
    solids: Solids,
    outline: MeshBasicMaterial,
    depth: MeshBasicMaterial,
  ) {
    this.group = solids.group(paints, String(frame));
    for (const { frame: own, origin_m, along, places_m, radius_m } of ARM_SOLIDS) {
      if (own !== frame) continue;
      const [from, to] = places_m.map((place_m) =>
        new Vector3(...along).multiplyScalar(place_m).add(new Vector3(...origin_m)),
      );
      if (!from || !to) continue;
      this.rods.push({ from, to, radius_m });
      this.rodsNow.push({ from: from.clone(), to: to.clone(), radius_m });
    }
    this.surfaces = this.group.children.filter((one) => one instanceof Mesh);
    const whole = mergeGeometries(this.surfaces.map(({ geometry }) => geometry));
    this.others = [new Mesh(whole, depth), new Mesh(grown(whole.clone()), outline)];
    this.others.forEach((mesh, i) => {
      mesh.renderOrder = i === 0 ? FADED_ORDER.depth : FADED_ORDER.outline;
      mesh.visible = false;
    });
    this.group.add(...this.others);
  }

  moved(): void {
    this.rods.forEach((rod, i) => {
      const now = this.rodsNow[i];
      now?.from.copy(rod.from).applyMatrix4(this.group.matrix);
      now?.to.copy(rod.to).applyMatrix4(this.group.matrix);
    });
  }

  /** Returns whether it still changes. `most` is the opacity of a link that covers nothing. */
  update(
    isCovered: (rod: Rod) => boolean,
    elapsed_ms: number,
    jumps: boolean,
    most: number,
  ): boolean {
    const covers = this.rodsNow.some(isCovered);
    this.fade = faded(this.fade, covers, elapsed_ms, jumps);
    const opacity = Math.min(most, this.fade.opacity);
    this.paints.fade(`${this.frame}`, opacity);
    for (const mesh of this.others) mesh.visible = opacity < 1;
    for (const mesh of this.surfaces) mesh.renderOrder = opacity < 1 ? FADED_ORDER.surface : 0;
    return !isSettled(this.fade, covers);
  }
}

/** What a link must not cover. */
export interface Covered {
  readonly eye: Vector3;
  readonly places: readonly Vector3[];
  /** Radius of the ring around a place, divided by its distance from the eye. */
  readonly ringPerM: number;
}

export class Arm {
  readonly group = new Group();
  private readonly frames: Matrix4[] = [];
  private readonly links: readonly Link[];
  private readonly outline = new MeshBasicMaterial({ side: BackSide, transparent: true });
  private readonly depth = new MeshBasicMaterial({ colorWrite: false, transparent: true });

  constructor(private readonly paints: Paints) {
    const { outline, depth } = this;
    this.links = [...[0, 1, 2, 3, 4, 5].map(solidsOf), gripper()].map(
      (solids, frame) => new Link(paints, frame, solids, outline, depth),
    );
    this.links.forEach(({ group }, frame) => {
      this.group.add(group);
      if (frame === 0) return;
      group.matrixAutoUpdate = false;
      this.frames.push(group.matrix);
    });
  }

  dispose(): void {
    this.outline.dispose();
    this.depth.dispose();
  }

  recolor(outline: string): void {
    this.outline.color.set(outline);
  }

  /** Returns how far the tool is turned about the vertical. */
  pose(joints_rad: readonly number[]): number {
    linkFrames(joints_rad, this.frames);
    for (const link of this.group.children) link.matrixWorldNeedsUpdate = true;
    for (const link of this.links) link.moved();
    const flange = this.frames[5];
    return flange ? toolTurn(flange) : 0;
  }

  /**
   * Makes the links transparent that cover something, and all by `most`: low from above, where the arm would hide the
   * table. Returns whether a link still changes.
   */
  fade(
    { eye, places, ringPerM }: Covered,
    elapsed_ms: number,
    jumps: boolean,
    most: number,
  ): boolean {
    const isCovered = (rod: Rod): boolean =>
      this.group.visible && places.some((at) => covers(rod, eye, at, ringPerM));
    this.paints.fade('', most);
    this.outline.opacity = 0.3 + 0.7 * most;
    return this.links.reduce(
      (changes, link) => link.update(isCovered, elapsed_ms, jumps, most) || changes,
      false,
    );
  }
}
