import { expect, it } from 'vitest';
import { unseenSpans } from './fog';

it('has a span for each row that a run of unseen cells crosses', () => {
  // 4 columns: the first row is unseen but for its last cell, then five unseen cells over two rows.
  const runs: [number, number][] = [
    [0, 3],
    [1, 1],
    [0, 5],
    [2, 3],
  ];
  expect(unseenSpans({ columns: 4, runs })).toEqual([
    [0, 0, 3],
    [1, 0, 4],
    [2, 0, 1],
  ]);
});
