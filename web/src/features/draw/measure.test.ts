import { expect, it } from 'vitest';
import { measured } from './measure';

it('says the size of each kind of shape in its middle', () => {
  const post = { kind: 'post', center: [10, 20], radius_mm: 15 } as const;
  expect(measured(post)).toEqual({ at: [10, 20], text: '⌀ 30 mm' });
  const ring = [
    [0, 0],
    [75, 0],
    [75, 45],
    [0, 45],
  ] as const;
  expect(measured({ kind: 'area', rings: [ring] })).toEqual({
    at: [37.5, 22.5],
    text: '75 × 45 mm',
  });
  const points = [
    [0, 0],
    [30, 40],
    [30, 90],
  ] as const;
  // Half of the way along it.
  expect(measured({ kind: 'wall', points, width_mm: 14 })).toEqual({
    at: [30, 40],
    text: '100 mm',
  });
});
