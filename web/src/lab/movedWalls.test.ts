import { describe, expect, it } from 'vitest';
import { MovedWalls } from './movedWalls';
import { lumenOf } from './testing';

const FAR = { at_m: [9, 9], radius_m: 0.0025 } as const;
/** A room of 40 × 20 cm with its corner at the origin, and knots 10 cm apart. */
const ROOM = [
  [0, 0],
  [0.1, 0],
  [0.2, 0],
  [0.3, 0],
  [0.4, 0],
  [0.4, 0.2],
  [0.2, 0.2],
  [0, 0.2],
] as const;
/** Clockwise: the free space is outside. */
const POST = [
  [0.19, 0.09],
  [0.19, 0.11],
  [0.21, 0.11],
  [0.21, 0.09],
] as const;

/** Points of an outline at an x, from the lowest to the highest. */
function heightsAt(walls: MovedWalls, x_m: number): number[] {
  const ys = new Set<number>();
  for (const [from, to] of walls.outlines) {
    for (let i = from; i < to; i++) {
      if (Math.abs((walls.point_m[2 * i] ?? NaN) - x_m) < 1e-9)
        ys.add(walls.point_m[2 * i + 1] ?? 0);
    }
  }
  return [...ys].sort((a, b) => a - b);
}

describe('moved walls', () => {
  it('are where they are drawn while the wave is zero', () => {
    const walls = new MovedWalls(lumenOf([ROOM]));
    walls.move([0, 0, 0, 0, 0], FAR);
    const places = new Set<string>();
    for (let i = 0; i < (walls.outlines[0]?.[1] ?? 0); i++) {
      places.add(`${walls.point_m[2 * i]},${walls.point_m[2 * i + 1]}`);
      expect(walls.rests(i)).toBe(true);
    }
    expect([...places].sort()).toEqual(ROOM.map((place) => place.join()).sort());
    expect(walls.covers([0.2, 0.1])).toBe(false);
    expect(walls.covers([0.2, -0.001])).toBe(true);
  });

  it('change when they have moved visibly since they last changed', () => {
    const walls = new MovedWalls(lumenOf([ROOM]));
    const to = (wave_m: number) => walls.move(Array<number>(5).fill(wave_m), FAR);
    expect([0, 0, 0.0001, 0.0002, 0.0003, 0.0004].map(to)).toEqual([
      true,
      false,
      false,
      true,
      false,
      true,
    ]);
    expect(walls.moves).toBe(3);
    expect(heightsAt(walls, 0.2)[0]).toBeCloseTo(0.0004, 9);
    to(0.0003);
    expect(heightsAt(walls, 0.2)[0]).toBeCloseTo(0.0004, 9);
  });

  it('close in as far as the wave, and keep their corners', () => {
    const walls = new MovedWalls(lumenOf([ROOM]));
    walls.move([0.01, 0.01, 0.01, 0.01, 0.01], FAR);
    expect(heightsAt(walls, 0.2)).toEqual([0.01, 0.19].map((y) => expect.closeTo(y, 9) as number));
    expect(walls.covers([0.2, 0.009])).toBe(true);
    expect(walls.covers([0.2, 0.011])).toBe(false);
    // Beside a corner, where both walls cover the place.
    expect(walls.covers([0.005, 0.005])).toBe(true);
    expect(walls.covers([0.011, 0.011])).toBe(false);
  });

  it('interpolate the wave between its knots, up to the limit of each vertex', () => {
    const low = [
      [0, 0],
      [0.15, 0],
      [0.4, 0],
      [0.4, 0.2],
      [0, 0.2],
    ] as const;
    const walls = new MovedWalls(lumenOf([low], { limit_m: 0.015 }));
    walls.move([0, 0.004, 0.008, 0.1, 0.1], FAR);
    // The lower wall: at x = 0.15 between the second and the third knot.
    expect(walls.closing_m[1]).toBeCloseTo(0.006, 9);
    expect(walls.closing_m[2]).toBeCloseTo(0.015, 9);
  });

  it('stand out round from a post', () => {
    const walls = new MovedWalls(lumenOf([ROOM, POST]));
    walls.move([0.01, 0.01, 0.01, 0.01, 0.01], FAR);
    expect(walls.covers([0.2, 0.1])).toBe(true);
    expect(walls.covers([0.2, 0.119])).toBe(true);
    expect(walls.covers([0.2, 0.121])).toBe(false);
    // Diagonally from a corner, 9 mm and 11 mm away.
    const along = Math.SQRT1_2;
    expect(walls.covers([0.21 + 0.009 * along, 0.11 + 0.009 * along])).toBe(true);
    expect(walls.covers([0.21 + 0.011 * along, 0.11 + 0.011 * along])).toBe(false);
  });

  it('stop at the bead', () => {
    const walls = new MovedWalls(lumenOf([ROOM]));
    walls.move([0.02, 0.02, 0.02, 0.02, 0.02], { at_m: [0.2, 0.0125], radius_m: 0.0025 });
    expect(walls.closing_m[2]).toBeCloseTo(0.01, 9);
  });

  it('have no steps: a wall beside a place that has closed in closes in, too', () => {
    const steep = Array.from({ length: 11 }, (_, i) => [0.01 * i, 0] as const);
    const walls = new MovedWalls(
      lumenOf([[...steep, [0.1, 0.2] as const, [0, 0.2] as const]], { knot_m: 0.01 }),
    );
    walls.move([0, 0, 0, 0, 0, 0.03, 0, 0, 0, 0, 0], FAR);
    // The disc around x = 0.05 has a radius of 3 cm.
    expect(walls.covers([0.05, 0.029])).toBe(true);
    expect(walls.covers([0.07, 0.02])).toBe(true);
    expect(walls.covers([0.072, 0.022])).toBe(false);
    expect(walls.covers([0.015, 0.005])).toBe(false);
  });

  it('are computed in place, with the same result again', () => {
    const walls = new MovedWalls(lumenOf([ROOM, POST]));
    const { point_m } = walls;
    walls.move([0.01, 0.01, 0.01, 0.01, 0.01], FAR);
    const before = point_m.slice();
    walls.move([0, 0, 0, 0, 0], FAR);
    expect(point_m).not.toEqual(before);
    walls.move([0.01, 0.01, 0.01, 0.01, 0.01], FAR);
    expect(walls.point_m).toBe(point_m);
    expect(point_m).toEqual(before);
  });

  it('do not fail on a wave of another map', () => {
    const walls = new MovedWalls(lumenOf([ROOM]));
    for (const wave_m of [[], [0.01], [0.01, 0.02]]) {
      walls.move(wave_m, FAR);
      expect(walls.point_m.every(Number.isFinite)).toBe(true);
    }
  });
});
