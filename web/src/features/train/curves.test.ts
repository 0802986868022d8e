import { describe, expect, it } from 'vitest';
import { columnsOf, KINDS, rangeAround, readWords, updateText } from './curves';
import { pointOf } from './testing';

const kind = (id: string) => {
  const found = KINDS.find((one) => one.id === id);
  if (!found) throw new Error(id);
  return found;
};

describe('the columns', () => {
  it('have the updates of both trainings together', () => {
    const a = [pointOf(100), pointOf(200)];
    const b = [pointOf(100, { loss_mean: 0.5 }), pointOf(300)];
    const columns = columnsOf(kind('loss'), [a, b]);
    expect(columns[0]).toEqual([100, 200, 300]);
    expect(columns[3]).toEqual([0.01, 0.01, null]);
    expect(columns[6]).toEqual([0.5, null, 0.01]);
    expect(readWords(kind('loss'), ['a', 'b'], columns, 0)).toBe(
      'After 100 updates: a 0.010, b 0.500',
    );
    expect(readWords(kind('loss'), ['a', 'b'], columns, 1)).toBe('After 200 updates: a 0.010');
  });

  it('have a band around the reward and the examinations', () => {
    expect(kind('reward').values(pointOf(100))).toEqual([0.7, 0.3, 0.5]);
    expect(kind('reward').values(pointOf(100, { reward_mean: null }))).toEqual([null, null, null]);
    const examined = {
      ...{ episodes: 200, reached: 100, collided: 100, timed_out: 0 },
      reached_wilson95: [0.43, 0.57] as [number, number],
    };
    const [high, low, share] = kind('examination').values(pointOf(100, { examined }));
    expect([high, low, share].map((value) => Math.round(value ?? NaN))).toEqual([57, 43, 50]);
  });

  it('have no share without episodes', () => {
    expect(kind('exploring').values(pointOf(100))[2]).toBe(75);
    expect(kind('exploring').values(pointOf(100, { ended: 0, reached: 0 }))[2]).toBeNull();
  });
});

describe('an axis', () => {
  it('has room around the values, also without values', () => {
    expect(rangeAround(1, 0)).toEqual([-0.06, 1.06]);
    expect(rangeAround(NaN, NaN)).toEqual([0, 1]);
  });

  it('has short numbers', () => {
    expect([500, 1500, 4000, 1250].map(updateText)).toEqual(['500', '1.5k', '4k', '1250']);
  });
});
