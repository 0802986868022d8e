import { expect, it } from 'vitest';
import { carved, simplified } from './carve';
import type { Mm, Shape, Wall } from './drawing';

const ACROSS: Mm[] = [
  [50, -100],
  [50, 100],
];

const WALL: Wall = {
  kind: 'wall',
  points: [
    [0, 0],
    [100, 0],
  ],
  width_mm: 10,
};

/** Twice the signed area of each ring, summed up. */
function areaMm2(shape: Shape | undefined): number {
  if (shape?.kind !== 'area') return NaN;
  const twice = (ring: readonly Mm[]): number =>
    ring.reduce((sum, [x, y], index) => {
      const [x2, y2] = ring[(index + 1) % ring.length] ?? [0, 0];
      return sum + x * y2 - x2 * y;
    }, 0);
  return Math.abs(shape.rings.reduce((sum, ring) => sum + twice(ring), 0)) / 2;
}

it('cuts a wall into two, each with a round end', () => {
  const pieces = carved([WALL], [ACROSS], 20);
  expect(pieces).toHaveLength(2);
  // 40 mm of the wall, and half a disc.
  for (const piece of pieces) expect(areaMm2(piece)).toBeCloseTo(400 + (Math.PI * 25) / 2, -1);
});

it('leaves shapes that it does not touch as they are', () => {
  const away: Shape = { kind: 'post', center: [200, 0], radius_mm: 10 };
  expect(carved([away, WALL], [ACROSS], 20)[0]).toBe(away);
});

it('removes what it covers', () => {
  expect(carved([{ kind: 'post', center: [50, 0], radius_mm: 9 }], [ACROSS], 20)).toEqual([]);
  expect(carved([{ kind: 'post', center: [3, 4], radius_mm: 10 }], [[[0, 0]]], 40)).toEqual([]);
});

it('makes a hole in an area, and keeps an island in a hole', () => {
  const square: Shape = {
    kind: 'area',
    rings: [
      [
        [0, 0],
        [100, 0],
        [100, 100],
        [0, 100],
      ],
    ],
  };
  const [area, ...others] = carved([square], [[[50, 50]]], 40);
  expect(others).toEqual([]);
  expect(area?.kind === 'area' && area.rings).toHaveLength(2);
  expect(areaMm2(area)).toBeCloseTo(10_000 - Math.PI * 400, -1);
  // A ring cut by a smaller ring: the middle is left as an island.
  const circle = Array.from({ length: 40 }, (_, index): Mm => {
    const angle = (index / 39) * 2 * Math.PI;
    return [50 + 30 * Math.cos(angle), 50 + 30 * Math.sin(angle)];
  });
  const pieces = carved([square], [circle], 6);
  expect(pieces.map((piece) => piece.kind === 'area' && piece.rings.length).sort()).toEqual([1, 2]);
});

it('needs few points for a line drawn by hand', () => {
  const shaky = Array.from({ length: 200 }, (_, index): Mm => [index, Math.sin(index) * 0.4]);
  expect(simplified(shaky, 1).length).toBeLessThan(6);
  const corner = [
    ...Array.from({ length: 50 }, (_, i): Mm => [i, 0]),
    ...Array.from({ length: 50 }, (_, i): Mm => [50, i]),
  ];
  expect(simplified(corner, 1)).toContainEqual([50, 0]);
  expect(simplified([[1, 2]], 1)).toEqual([[1, 2]]);
  // There and back, and round to where it began.
  const back: Mm[] = [
    [0, 0],
    [100, 0],
    [200, 0],
    [100, 0],
    [20, 0],
  ];
  expect(simplified(back, 1)).toEqual([
    [0, 0],
    [200, 0],
    [20, 0],
  ]);
  const loop: Mm[] = [
    [0, 0],
    [50, 0],
    [100, 0],
    [100, 100],
    [0, 100],
    [0, 0],
  ];
  expect(simplified(loop, 1)).toEqual([
    [0, 0],
    [100, 0],
    [100, 100],
    [0, 100],
    [0, 0],
  ]);
});
