import { expect, it } from 'vitest';
import { amended, onward, redone, startOf, undone } from './undo';

it('goes back and forth, and a change drops what was undone', () => {
  const three = [2, 3].reduce(onward<number>, startOf(1));
  const one = undone(undone(three));
  expect(one.present).toBe(1);
  expect(undone(one)).toBe(one);
  expect(redone(redone(one))).toEqual(three);
  expect(redone(three)).toBe(three);
  const other = onward(undone(three), 7);
  expect(other).toEqual({ past: [1, 2], present: 7, future: [] });
});

it('goes on with a change', () => {
  const two = onward(startOf(1), 2);
  expect(undone(amended(two, 3))).toEqual({ past: [], present: 1, future: [3] });
});

it('forgets the oldest states', () => {
  const long = Array.from({ length: 500 }, (_, index) => index + 1).reduce(
    onward<number>,
    startOf(0),
  );
  expect([long.present, long.past.length, long.past[0]]).toEqual([500, 200, 300]);
});
