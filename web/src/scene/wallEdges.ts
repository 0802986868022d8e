// The upper edges of moved walls: the outlines without the loops that lie inside the walls. Pure.

import type { MovedWalls } from '../lab/movedWalls';
import { TRAY_UP_M } from './tray';

/** A point that is less deep in a wall is on its edge. */
const DEPTH_M = 5e-5;
const SAME_PLACE_M = 1e-6;

/** For each vertex, the vertices whose discs can reach its points. */
function neighbours({ foot_m, limit_m }: MovedWalls): Uint32Array[] {
  const count = limit_m.length;
  return Array.from({ length: count }, (_, i) => {
    const near: number[] = [];
    for (let j = 0; j < count; j++) {
      const x = (foot_m[2 * j] ?? 0) - (foot_m[2 * i] ?? 0);
      const y = (foot_m[2 * j + 1] ?? 0) - (foot_m[2 * i + 1] ?? 0);
      const reach_m = (limit_m[i] ?? 0) + (limit_m[j] ?? 0);
      if (i !== j && x * x + y * y < reach_m * reach_m) near.push(j);
    }
    return Uint32Array.from(near);
  });
}

export class WallEdges {
  /** Three numbers for each end of a line. */
  readonly ends: Float32Array;
  /** How many ends are in use. */
  count = 0;
  private readonly near: readonly Uint32Array[];
  /** Square of the radius within which a vertex covers points. */
  private readonly reach: Float64Array;
  /** 1 for each point that lies inside a wall. */
  private readonly covered: Uint8Array;

  constructor(private readonly walls: MovedWalls) {
    this.ends = new Float32Array(6 * walls.capacity);
    this.near = neighbours(walls);
    this.reach = new Float64Array(walls.limit_m.length);
    this.covered = new Uint8Array(walls.capacity);
  }

  /** Takes the outlines as they are now. */
  update(): void {
    const { covered, reach, walls } = this;
    this.count = 0;
    walls.closing_m.forEach((closing_m, vertex) => {
      reach[vertex] = Math.max(0, closing_m - DEPTH_M) ** 2;
    });
    for (const [from, to] of walls.outlines) {
      for (let i = from; i < to; i++) covered[i] = this.isInside(i) ? 1 : 0;
      for (let i = from; i < to; i++) {
        const next = i + 1 < to ? i + 1 : from;
        if ((this.covers(i) && this.covers(next)) || this.areSame(i, next)) continue;
        this.end(i, next, this.covers(i) ? 1 - this.visible(next, i) : 0);
        this.end(i, next, this.covers(next) ? this.visible(i, next) : 1);
      }
    }
  }

  /** Whether a point lies inside a wall. */
  covers(point: number): boolean {
    return this.covered[point] === 1;
  }

  /** Two pieces of a straight wall meet in two points. */
  private areSame(one: number, other: number): boolean {
    const { point_m } = this.walls;
    const x = (point_m[2 * one] ?? 0) - (point_m[2 * other] ?? 0);
    const y = (point_m[2 * one + 1] ?? 0) - (point_m[2 * other + 1] ?? 0);
    return Math.abs(x) + Math.abs(y) < SAME_PLACE_M;
  }

  private isInside(point: number): boolean {
    const { point_m, foot_m, vertexOf } = this.walls;
    const { reach } = this;
    const [x, y] = [point_m[2 * point] ?? 0, point_m[2 * point + 1] ?? 0];
    for (const vertex of this.near[vertexOf[point] ?? 0] ?? []) {
      const dx = x - (foot_m[2 * vertex] ?? 0);
      const dy = y - (foot_m[2 * vertex + 1] ?? 0);
      if (dx * dx + dy * dy < (reach[vertex] ?? 0)) return true;
    }
    return false;
  }

  /** The visible share of the way from a point on the edge to a point inside a wall. */
  private visible(outside: number, inside: number): number {
    let share = 1;
    for (const vertex of this.near[this.walls.vertexOf[inside] ?? 0] ?? []) {
      const [out_m, in_m] = [this.depth_m(outside, vertex), this.depth_m(inside, vertex)];
      if (in_m > DEPTH_M && out_m < in_m) share = Math.min(share, -out_m / (in_m - out_m));
    }
    return Math.max(0, share);
  }

  /** How deep a point is inside the disc of a vertex. */
  private depth_m(point: number, vertex: number): number {
    const { point_m, foot_m, closing_m } = this.walls;
    const x = (point_m[2 * point] ?? 0) - (foot_m[2 * vertex] ?? 0);
    const y = (point_m[2 * point + 1] ?? 0) - (foot_m[2 * vertex + 1] ?? 0);
    return (closing_m[vertex] ?? 0) - Math.sqrt(x * x + y * y);
  }

  private end(from: number, to: number, share: number): void {
    const { point_m } = this.walls;
    const [x, y] = [point_m[2 * from] ?? 0, point_m[2 * from + 1] ?? 0];
    this.ends[3 * this.count] = x + share * ((point_m[2 * to] ?? 0) - x);
    this.ends[3 * this.count + 1] = y + share * ((point_m[2 * to + 1] ?? 0) - y);
    this.ends[3 * this.count + 2] = TRAY_UP_M;
    this.count += 1;
  }
}
