import { expect, it } from 'vitest';
import type { SeenMessage } from '../net/protocol.gen';
import { seenAt } from './obstacleMap';

const SEEN: SeenMessage = {
  number: 1,
  workspace: { x_min_m: 0, x_max_m: 3, y_min_m: 0, y_max_m: 2 },
  columns: 3,
  rows: 2,
  // The lower row: free, free, obstacle; the upper one: obstacle, unknown, unknown.
  runs: [
    [1, 2],
    [2, 2],
    [0, 2],
  ],
};

it('the obstacle map reports whether the camera has shown a point', () => {
  const isSeen = seenAt(SEEN);
  expect(isSeen([0.5, 0.5])).toBe(true);
  expect(isSeen([0.5, 2])).toBe(true);
  expect(isSeen([1.5, 1.5])).toBe(false);
});
