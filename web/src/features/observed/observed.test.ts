import { describe, expect, it } from 'vitest';
import type { SeenMessage } from '../../net/protocol.gen';
import type { Rgba } from '../../plan/pixels';
import { seenPixels } from './drawObserved';

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
const COLORS: readonly [Rgba, Rgba, Rgba] = [
  [1, 0, 0, 255],
  [2, 0, 0, 255],
  [3, 0, 0, 255],
];

describe('the observed area', () => {
  it('is drawn with the upper row first', () => {
    const red = [...seenPixels(SEEN, COLORS)].filter((_, index) => index % 4 === 0);
    expect(red).toEqual([3, 1, 1, 2, 2, 3]);
  });

  it('never exceeds its picture', () => {
    const long = { ...SEEN, runs: [[1, 99]] as [number, number][] };
    expect(seenPixels(long, COLORS)).toHaveLength(24);
  });
});
