// Walls that have closed in as a wave along the lumen says. Around every point of a wall lies a disc, whose radius is how
// far the wall has closed in there; between two vertices it changes linearly. The outline runs around the discs. Pure.

import type { Lumen } from '../net/protocol.gen';
import type { Vec2 } from './geometry';

/** Steepest change of a radius along a wall. Of discs that differ more, one lies inside the other. */
const STEEPEST = 0.97;
/** Vertices that are nearer than this share a corner. */
const SAME_PLACE_M = 1e-6;
/** Longest piece of an arc. */
const ARC_RAD = 0.25;
/** A wall that has closed in less is at rest. */
const LEAST_M = 1e-5;
/** A smaller motion is not visible: a fifth of a pixel of the plan. */
const VISIBLE_M = 1.5e-4;
/** Points of arcs for each vertex, on average and at most. */
const MOST_ARC_POINTS = 2;

/** What stands between the walls: they stop at it. */
export interface Ball {
  readonly at_m: Vec2;
  readonly radius_m: number;
}

/** Consecutive entries of a list: the first, and the one after the last. */
export type Range = readonly [from: number, to: number];

/** A straight piece of wall between two vertices, with the free space on its left. */
interface Piece {
  readonly from: number;
  readonly to: number;
  /** Unit vector. */
  readonly x: number;
  readonly y: number;
  readonly length_m: number;
  /** Turn from the piece before: negative at a corner that stands out into the free space. */
  readonly turn_rad: number;
}

const angleOf = (ax: number, ay: number, bx: number, by: number): number =>
  Math.atan2(ax * by - ay * bx, ax * bx + ay * by);

/** The pieces of a closed outline whose first vertex has the number `first`. */
function piecesOf(places: readonly Vec2[], first: number): Piece[] {
  const straight = places.flatMap(([x, y], i) => {
    const next = (i + 1) % places.length;
    const [toX, toY] = places[next] ?? [x, y];
    const length_m = Math.hypot(toX - x, toY - y);
    if (length_m < SAME_PLACE_M) return [];
    const along = { x: (toX - x) / length_m, y: (toY - y) / length_m };
    return [{ from: first + i, to: first + next, ...along, length_m }];
  });
  return straight.map((piece, i) => {
    const before = straight.at(i - 1) ?? piece;
    return { ...piece, turn_rad: angleOf(before.x, before.y, piece.x, piece.y) };
  });
}

/** The walls of a map. Their outline is computed in place, because it changes with every state. */
export class MovedWalls {
  readonly map: string;
  /** The most points. */
  readonly capacity: number;
  /** The points of each closed outline. They may cross themselves where the wall covers them. */
  readonly outlines: Range[] = [];
  /** x and y of each point. */
  readonly point_m: Float64Array;
  /** Of each point, from the wall into the free space. */
  readonly normal: Float64Array;
  /** The vertex to which a point belongs. */
  readonly vertexOf: Uint32Array;
  /** x and y of each vertex: where the wall is at rest. */
  readonly foot_m: Float64Array;
  /** How far each vertex has closed in, as it shows. */
  readonly closing_m: Float64Array;
  /** The same in the latest state, also where that does not show yet. */
  private readonly newest_m: Float64Array;
  /** Visible motions so far. */
  moves = 0;
  private count = 0;
  /** Points that arcs may still have. */
  private spare = 0;
  private readonly rings: readonly Range[];
  private readonly pieces: readonly (readonly Piece[])[];
  /** The most that each vertex closes in. */
  readonly limit_m: Float64Array;
  /** Place along the lumen, in knots of the wave. */
  private readonly knot: Float64Array;
  /** Distance from the vertex before. */
  private readonly gap_m: Float64Array;

  constructor({ map, knot_m, rings }: Lumen) {
    this.map = map;
    let vertices = 0;
    this.rings = rings.map(({ place_m }) => [vertices, (vertices += place_m.length)]);
    this.pieces = rings.map(({ place_m }, i) => piecesOf(place_m, this.rings[i]?.[0] ?? 0));
    const flat = (listOf: (ring: Lumen['rings'][number]) => number[]): Float64Array =>
      Float64Array.from(rings.flatMap(listOf));
    this.foot_m = flat(({ place_m }) => place_m.flat());
    this.limit_m = flat(({ limit_m }) => limit_m);
    this.knot = flat(({ along_m }) => along_m.map((along) => along / knot_m));
    this.gap_m = flat(({ place_m }) =>
      place_m.map(([x, y], i) => {
        const [fromX, fromY] = place_m.at(i - 1) ?? [x, y];
        return Math.hypot(x - fromX, y - fromY);
      }),
    );
    this.closing_m = new Float64Array(vertices).fill(NaN);
    this.newest_m = new Float64Array(vertices);
    this.capacity = (2 + MOST_ARC_POINTS) * vertices;
    this.point_m = new Float64Array(2 * this.capacity);
    this.normal = new Float64Array(2 * this.capacity);
    this.vertexOf = new Uint32Array(this.capacity);
  }

  /** Moves the outlines, and returns whether that is visible. `wave_m` is how far walls close in at the knots. */
  move(wave_m: readonly number[], ball: Ball): boolean {
    this.close(wave_m, ball);
    this.smooth();
    const { closing_m, newest_m } = this;
    const isVisible = closing_m.some(
      (old_m, i) => !(Math.abs((newest_m[i] ?? 0) - old_m) < VISIBLE_M),
    );
    if (isVisible) {
      closing_m.set(newest_m);
      this.moves += 1;
      this.trace();
    }
    return isVisible;
  }

  /** Whether a point of the table is in a wall: then the outlines do not run around it. */
  covers([x, y]: Vec2): boolean {
    const { point_m } = this;
    let turns = 0;
    for (const [from, to] of this.outlines) {
      let [beforeX, beforeY] = [point_m[2 * to - 2] ?? 0, point_m[2 * to - 1] ?? 0];
      for (let i = from; i < to; i++) {
        const [atX, atY] = [point_m[2 * i] ?? 0, point_m[2 * i + 1] ?? 0];
        const left = (atX - beforeX) * (y - beforeY) - (x - beforeX) * (atY - beforeY);
        if (beforeY <= y && atY > y && left > 0) turns += 1;
        if (beforeY > y && atY <= y && left < 0) turns -= 1;
        [beforeX, beforeY] = [atX, atY];
      }
    }
    return turns <= 0;
  }

  /** Whether the wall is where it is drawn, at the place of a point. */
  rests(point: number): boolean {
    return (this.closing_m[this.vertexOf[point] ?? 0] ?? 0) < LEAST_M;
  }

  private close(wave_m: readonly number[], { at_m, radius_m }: Ball): void {
    const { foot_m, newest_m, limit_m, knot } = this;
    const last = Math.max(0, wave_m.length - 2);
    for (let i = 0; i < newest_m.length; i++) {
      const at = knot[i] ?? 0;
      const low = Math.min(last, Math.floor(at));
      const before_m = wave_m[low] ?? 0;
      const wave = before_m + (at - low) * ((wave_m[low + 1] ?? before_m) - before_m);
      const [x, y] = [at_m[0] - (foot_m[2 * i] ?? 0), at_m[1] - (foot_m[2 * i + 1] ?? 0)];
      const room_m = Math.max(0, Math.sqrt(x * x + y * y) - radius_m);
      newest_m[i] = Math.min(wave, limit_m[i] ?? 0, room_m);
    }
  }

  /** Enlarges discs that lie inside others: every outline is then smooth. */
  private smooth(): void {
    const { newest_m, gap_m } = this;
    const grow = (i: number, from: number, gap: number): void => {
      const least = (newest_m[from] ?? 0) - STEEPEST * (gap_m[gap] ?? 0);
      if (least > (newest_m[i] ?? 0)) newest_m[i] = least;
    };
    for (const [from, to] of this.rings) {
      // The second time, what was at the end arrives at the beginning.
      for (let round = 0; round < 2; round++) {
        for (let i = from; i < to; i++) grow(i, i > from ? i - 1 : to - 1, i);
        for (let i = to - 1; i >= from; i--) grow(i > from ? i - 1 : to - 1, i, i);
      }
    }
  }

  private trace(): void {
    const { closing_m, outlines } = this;
    this.count = 0;
    this.spare = MOST_ARC_POINTS * closing_m.length;
    outlines.length = 0;
    const tilt = ({ from, to, length_m }: Piece): number => {
      const slope = ((closing_m[to] ?? 0) - (closing_m[from] ?? 0)) / length_m;
      return Math.asin(Math.max(-1, Math.min(1, slope)));
    };
    for (const pieces of this.pieces) {
      const first = this.count;
      const last = pieces.at(-1);
      let before_rad = last ? tilt(last) : 0;
      for (const piece of pieces) {
        const tilt_rad = tilt(piece);
        this.turn(piece, tilt_rad, piece.turn_rad + tilt_rad - before_rad);
        before_rad = tilt_rad;
        const [sin, cos] = [Math.sin(tilt_rad), Math.cos(tilt_rad)];
        const [x, y] = [-piece.y * cos - piece.x * sin, piece.x * cos - piece.y * sin];
        this.add(piece.from, x, y);
        this.add(piece.to, x, y);
      }
      outlines.push([first, this.count]);
    }
  }

  /** Goes around the disc at the beginning of a piece if the corner stands out. */
  private turn(piece: Piece, tilt_rad: number, turn_rad: number): void {
    if (turn_rad > -ARC_RAD || (this.closing_m[piece.from] ?? 0) < LEAST_M) return;
    const steps = Math.min(Math.ceil(-turn_rad / ARC_RAD), this.spare);
    this.spare -= steps;
    for (let step = 1; step < steps; step++) {
      const back_rad = tilt_rad - turn_rad * (1 - step / steps);
      const [sin, cos] = [Math.sin(back_rad), Math.cos(back_rad)];
      this.add(piece.from, -piece.y * cos - piece.x * sin, piece.x * cos - piece.y * sin);
    }
  }

  private add(vertex: number, normalX: number, normalY: number): void {
    const [x, y] = [2 * this.count, 2 * this.count + 1];
    const closing = this.closing_m[vertex] ?? 0;
    this.vertexOf[this.count] = vertex;
    this.normal[x] = normalX;
    this.normal[y] = normalY;
    this.point_m[x] = (this.foot_m[2 * vertex] ?? 0) + normalX * closing;
    this.point_m[y] = (this.foot_m[2 * vertex + 1] ?? 0) + normalY * closing;
    this.count += 1;
  }
}
