import { expect, it } from 'vitest';
import { follow } from './live';
import { trainingOf } from '../../lab/testing';
import { pointOf } from './testing';

it('adds new points, and takes all points of the first message of a connection', () => {
  const first = follow(undefined, { summary: trainingOf(), points: [pointOf(100)] }, true);
  const next = follow(first, { summary: trainingOf(), points: [pointOf(200)] }, false);
  expect(next.points.map(({ update }) => update)).toEqual([100, 200]);
  const same = follow(next, { summary: trainingOf({ updates: 250 }), points: [] }, false);
  expect(same.points).toBe(next.points);
  expect(same.summary.updates).toBe(250);
  const again = [100, 200, 300].map((update) => pointOf(update));
  expect(follow(same, { summary: trainingOf(), points: again }, true).points).toEqual(again);
});
