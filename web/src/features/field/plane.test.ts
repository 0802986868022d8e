import { expect, test } from 'vitest';
import type { Plane } from '../../net/protocol.gen';
import { sceneOf } from '../../lab/testing';
import { fieldWords, planeArrows, planePixels, planeQuery, SIDE_PX, strongestWords } from './plane';

/** A field that is strongest in the middle, with a pull toward the middle. */
const { reach_m, count } = planeQuery(sceneOf('open').parameters);
const places = Array.from({ length: count * count }, (_, place) => {
  const along = (index: number): number => (2 * reach_m * index) / (count - 1) - reach_m;
  return [along(place % count), along(Math.floor(place / count))] as const;
});
const plane: Plane = {
  field_t: places.map(([x, y]) => 0.0015 * Math.exp(-40 * Math.hypot(x, y))),
  pull_n: places.map(([x, y]) => [-x / 100, -y / 100]),
};
const RAMP = ['#000000', '#808080', '#ffffff'] as const;

test('the field is brightest below the magnet and fades out', () => {
  const pixels = planePixels(plane, RAMP);
  expect(pixels.length).toBe(4 * SIDE_PX * SIDE_PX);
  const at = (column: number, row: number): number[] => [
    ...pixels.slice(4 * (row * SIDE_PX + column), 4 * (row * SIDE_PX + column) + 4),
  ];
  const [middle, beside, corner] = [at(30, 30), at(40, 30), at(0, 0)];
  expect(middle[0]).toBe(255);
  expect(middle[3]).toBeGreaterThan(beside[3] ?? 0);
  expect(beside[3]).toBeGreaterThan(0);
  expect(corner[3]).toBe(0);
  expect(fieldWords(plane)).toBe('1.50');
});

test('arrows show the pull; the strongest pull has the longest arrow', () => {
  const arrows = planeArrows(plane);
  expect(arrows.length).toBeGreaterThan(50);
  for (const { from_m, to_m } of arrows) {
    expect(Math.hypot(...from_m)).toBeLessThanOrEqual(reach_m);
    expect(Math.hypot(...to_m)).toBeLessThan(Math.hypot(...from_m));
  }
  const length = ({ from_m, to_m }: (typeof arrows)[number]): number =>
    Math.hypot(to_m[0] - from_m[0], to_m[1] - from_m[1]);
  expect(Math.max(...arrows.map(length))).toBeLessThan(0.02);
  expect(strongestWords(plane)).toBe('2.12');
});
