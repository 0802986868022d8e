// The walls that have closed in: the tops of what they cover beyond their drawn place, and the sides of all walls. The
// positions are overwritten in place.

import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  Group,
  LineSegments,
  Mesh,
} from 'three';
import type { MovedWalls } from '../lab/movedWalls';
import type { Paints } from './paints';
import { BEVEL_M, TRAY_UP_M } from './tray';
import { WallEdges } from './wallEdges';

const CORNERS = 4;
const TRIANGLES = [0, 1, 2, 0, 2, 3] as const;
/** Over the bevel of the wall at rest, so that the floor does not show between the two. */
const OVERLAP_M = BEVEL_M + 3e-4;
/** Height of sides below a top, which would otherwise flicker through it. */
const COVERED_M = TRAY_UP_M - 8e-4;

const dynamic = (numbers: Float32Array): BufferAttribute =>
  new BufferAttribute(numbers, 3).setUsage(DynamicDrawUsage);

/** Sends the first `count` entries to the graphics card. */
function send(attribute: BufferAttribute, count: number): void {
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, 3 * count);
  attribute.needsUpdate = true;
}

export class MovedWallMesh {
  readonly group = new Group();
  private readonly solid = new BufferGeometry();
  private readonly lines = new BufferGeometry();
  private readonly edges: WallEdges;
  private readonly positions: BufferAttribute;
  private readonly normals: BufferAttribute;
  private readonly ends: BufferAttribute;
  /** Corners in use. */
  private corners = 0;
  /** Motions of the walls that are shown. */
  private moves = -1;

  constructor(
    paints: Paints,
    readonly of: MovedWalls,
  ) {
    // A top, a covered side and a side for each piece of an outline.
    const most = 3 * of.capacity;
    this.positions = dynamic(new Float32Array(3 * CORNERS * most));
    this.normals = dynamic(new Float32Array(3 * CORNERS * most));
    this.solid.setAttribute('position', this.positions).setAttribute('normal', this.normals);
    this.solid.setIndex(
      Array.from({ length: most }, (_, i) => TRIANGLES.map((at) => CORNERS * i + at)).flat(),
    );
    this.edges = new WallEdges(of);
    this.ends = dynamic(this.edges.ends);
    this.lines.setAttribute('position', this.ends);
    const mesh = new Mesh(this.solid, paints.lit('wall'));
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    this.group.add(mesh, new LineSegments(this.lines, paints.edge('wall-rim')));
    // Otherwise every change would need new bounds.
    for (const one of this.group.children) one.frustumCulled = false;
    this.update();
  }

  /** Takes the outlines as they are now. */
  update(): void {
    const { of, edges } = this;
    if (of.moves === this.moves) return;
    this.moves = of.moves;
    this.corners = 0;
    edges.update();
    for (const [from, to] of of.outlines) {
      for (let i = from; i < to; i++) {
        const next = i + 1 < to ? i + 1 : from;
        if (!of.rests(i) || !of.rests(next)) this.addTop(i, next);
        // Their places are not exact, so a little of a side that is covered may be visible.
        if (edges.covers(i) || edges.covers(next)) this.addSide(of.point_m, 2, i, next, COVERED_M);
      }
    }
    for (let end = 0; end < edges.count; end += 2) {
      this.addSide(edges.ends, 3, end, end + 1, TRAY_UP_M);
    }
    send(this.positions, this.corners);
    send(this.normals, this.corners);
    this.solid.setDrawRange(0, (TRIANGLES.length / CORNERS) * this.corners);
    send(this.ends, edges.count);
    this.lines.setDrawRange(0, edges.count);
  }

  /** Between two points of an outline and their places at rest. */
  private addTop(from: number, to: number): void {
    const { point_m } = this.of;
    this.addFoot(from);
    this.addFoot(to);
    this.add(point_m[2 * to] ?? 0, point_m[2 * to + 1] ?? 0, TRAY_UP_M, 0, 0, 1);
    this.add(point_m[2 * from] ?? 0, point_m[2 * from + 1] ?? 0, TRAY_UP_M, 0, 0, 1);
  }

  private addFoot(point: number): void {
    const { foot_m, normal, vertexOf } = this.of;
    const vertex = vertexOf[point] ?? 0;
    const x = (foot_m[2 * vertex] ?? 0) - (normal[2 * point] ?? 0) * OVERLAP_M;
    const y = (foot_m[2 * vertex + 1] ?? 0) - (normal[2 * point + 1] ?? 0) * OVERLAP_M;
    this.add(x, y, TRAY_UP_M, 0, 0, 1);
  }

  /** The free space is on its left. */
  private addSide(
    places: Float32Array | Float64Array,
    stride: number,
    from: number,
    to: number,
    height_m: number,
  ): void {
    const [x, y] = [places[stride * from] ?? 0, places[stride * from + 1] ?? 0];
    const [toX, toY] = [places[stride * to] ?? 0, places[stride * to + 1] ?? 0];
    const length_m = Math.hypot(toX - x, toY - y) || 1;
    const [normalX, normalY] = [(y - toY) / length_m, (toX - x) / length_m];
    this.add(x, y, 0, normalX, normalY, 0);
    this.add(x, y, height_m, normalX, normalY, 0);
    this.add(toX, toY, height_m, normalX, normalY, 0);
    this.add(toX, toY, 0, normalX, normalY, 0);
  }

  private add(x: number, y: number, z: number, nX: number, nY: number, nZ: number): void {
    this.positions.setXYZ(this.corners, x, y, z);
    this.normals.setXYZ(this.corners, nX, nY, nZ);
    this.corners += 1;
  }
}
