import { describe, expect, it } from 'vitest';
import { bestOf, type Fan, fanAxis, fanOf, percentAlong } from './fans';

function fanFrom(min: number, greatest: number): Fan {
  return { min, lower: min, mean: min, upper: greatest, greatest };
}

describe('a fan', () => {
  it('interpolates its quarters between the quantiles at (k + ½) / K', () => {
    const fan = fanOf(
      Array.from({ length: 32 }, (_, k) => (k + 0.5) / 32),
      0.5,
    );
    expect(fan.min).toBeCloseTo(1 / 64);
    expect(fan.lower).toBeCloseTo(0.25);
    expect(fan.upper).toBeCloseTo(0.75);
    expect(fan.greatest).toBeCloseTo(63 / 64);
  });

  it('is the same when quantiles cross', () => {
    expect(fanOf([3, 1, 4, 2], 2.5)).toEqual(fanOf([1, 2, 3, 4], 2.5));
  });

  it('is a line with only one quantile', () => {
    expect(fanOf([2], 2)).toEqual({ min: 2, lower: 2, mean: 2, upper: 2, greatest: 2 });
  });
});

describe('the axis', () => {
  it('has round numbers at both ends and contains all fans', () => {
    const axis = fanAxis([fanFrom(-0.93, 0.1), fanFrom(0.8, 1.1)]);
    expect([axis.from, axis.to, axis.step]).toEqual([-1, 1.5, 0.5]);
    expect(axis.ticks).toEqual([-1, -0.5, 0, 0.5, 1, 1.5]);
    expect(percentAlong(axis, -1)).toBe(0);
    expect(percentAlong(axis, 0.25)).toBe(50);
  });

  it('has few numbers for any span', () => {
    for (const span of [0, 1e-6, 0.013, 0.07, 0.4, 0.99, 2.4, 31]) {
      const { from, to, ticks } = fanAxis([fanFrom(0.97, 0.97 + span)]);
      expect(from).toBeLessThanOrEqual(0.97);
      expect(to).toBeGreaterThanOrEqual(0.97 + span);
      expect(ticks.length).toBeGreaterThanOrEqual(2);
      expect(ticks.length).toBeLessThanOrEqual(7);
    }
  });

  it('stays while the fans are inside and fill a third of it', () => {
    const axis = fanAxis([fanFrom(0, 1)]);
    expect(fanAxis([fanFrom(0.3, 0.7)], axis)).toBe(axis);
    expect(fanAxis([fanFrom(0.3, 1.1)], axis).to).toBeGreaterThan(1);
    expect(fanAxis([fanFrom(0.3, 0.5)], axis).to).toBeLessThan(1);
  });
});

describe('the best action', () => {
  it('has the greatest value', () => {
    expect(bestOf([0.1, 0.9, -2, 0.9])).toBe(1);
  });
});
