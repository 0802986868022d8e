import { describe, expect, it } from 'vitest';
import {
  firstWords,
  KINDS,
  newestExamination,
  rangeAround,
  updateSplits,
  updateText,
  withLast,
} from './curves';
import { trainingOf } from '../../lab/testing';
import { pointOf } from './testing';

const kind = (id: string) => {
  const found = KINDS.find((one) => one.id === id);
  if (!found) throw new Error(id);
  return found;
};

const EXAMINED = {
  ...{ episodes: 200, reached: 100, collided: 100, timed_out: 0 },
  reached_wilson95: [0.43, 0.57] as [number, number],
  all_pairs: false,
};

describe('the values', () => {
  it('have a band around the reward and the examinations', () => {
    expect(kind('reward').values(pointOf(100))).toEqual([0.7, 0.3, 0.5]);
    expect(kind('reward').values(pointOf(100, { reward_mean: null }))).toEqual([null, null, null]);
    const examined = EXAMINED;
    const [high, low, share] = kind('examination').values(pointOf(100, { examined }));
    expect([high, low, share].map((value) => Math.round(value ?? NaN))).toEqual([57, 43, 50]);
  });

  it('have no share without episodes', () => {
    expect(kind('exploring').values(pointOf(100))[2]).toBe(75);
    expect(kind('exploring').values(pointOf(100, { ended: 0, reached: 0 }))[2]).toBeNull();
  });
});

describe('the last examination', () => {
  const points = [pointOf(100), pointOf(200)];

  it('is at the end of the points', () => {
    const all = withLast(points, 200, EXAMINED);
    expect(all.map(({ examined }) => examined)).toEqual([null, EXAMINED]);
    expect(all[1]).toMatchObject(pointOf(200, { examined: EXAMINED }));
  });

  it('has a point of its own if the updates end between two points', () => {
    const all = withLast(points, 250, EXAMINED);
    expect(all.map(({ update }) => update)).toEqual([100, 200, 250]);
    expect(all.map(kind('exploring').values).at(-1)).toEqual([null, null, null]);
    expect(withLast(points, 250, null)).toBe(points);
  });

  it('is the newest one when it is done', () => {
    const small = { ...EXAMINED, reached: 20 };
    const curve = [pointOf(1000, { examined: small }), pointOf(1100)];
    expect(newestExamination(trainingOf(), curve)).toEqual({ examined: small, update: 1000 });
    expect(newestExamination(trainingOf(), [pointOf(100)])).toBeUndefined();
    const done = trainingOf({ stage: 'done', updates: 1100, examined: EXAMINED });
    expect(newestExamination(done, curve)).toEqual({ examined: EXAMINED, update: 1100 });
  });

  it('is announced before there is one', () => {
    expect(firstWords(4000, false)).toContain('after 1000 updates');
    expect(firstWords(500, false)).toContain('at the end');
    expect(firstWords(500, true)).toContain('ended before');
  });
});

describe('an axis', () => {
  it('ends with a number if a round step fits', () => {
    expect(updateSplits(1500, 9)).toEqual([0, 250, 500, 750, 1000, 1250, 1500]);
    expect(updateSplits(1500, 4)).toEqual([0, 500, 1000, 1500]);
    expect(updateSplits(8000, 6)).toEqual([0, 2000, 4000, 6000, 8000]);
    expect(updateSplits(1234, 5)).toEqual([0, 250, 500, 750, 1000]);
    expect(updateSplits(1, 5)).toEqual([0, 1]);
  });

  it('has room around the values, also without values', () => {
    expect(rangeAround(1, 0)).toEqual([-0.06, 1.06]);
    expect(rangeAround(NaN, NaN)).toEqual([0, 1]);
  });

  it('has short numbers', () => {
    expect([500, 1500, 4000, 1250].map(updateText)).toEqual(['500', '1.5k', '4k', '1250']);
  });
});
