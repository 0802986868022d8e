import { expect, test } from 'vitest';
import { errors_m, ghostAt, lastTick } from './comparison';
import { branchOf, comparisonOf } from './testing';

const short = branchOf('rl', [
  [0, 0, 0.03, 0.04],
  [1, 0, 1, 0],
]);
const long = branchOf('errt', [
  [0, 0, 0, 0],
  [0, 1, 0, 0],
  [0, 2, 0, 0],
]);

test('a ghost is at the position of its branch, and stays at the last one', () => {
  const comparison = comparisonOf(100, [short, long]);
  expect(lastTick(comparison)).toBe(115);
  expect(ghostAt(comparison, short, 105)?.bead_m).toEqual([0.03, 0.04]);
  expect(ghostAt(comparison, short, 111)?.tool_m).toEqual([1, 0]);
  expect(ghostAt(comparison, short, 115)?.tool_m).toEqual([1, 0]);
  expect(ghostAt(comparison, long, 115)?.tool_m).toEqual([0, 2]);
  // The first sample of each branch is the moment of the comparison.
  expect(ghostAt(comparison, long, 100)?.tool_m).toEqual([0, 0]);
});

test('a branch that has not started has no ghost', () => {
  const comparison = comparisonOf(100, [branchOf('rl', [])]);
  expect(lastTick(comparison)).toBe(100);
  expect(ghostAt(comparison, branchOf('rl', []), 100)).toBeUndefined();
});

test('errors are distances between tool and bead', () => {
  expect(errors_m(short)[0]).toBeCloseTo(0.05);
  expect(errors_m(short)[1]).toBe(0);
});
