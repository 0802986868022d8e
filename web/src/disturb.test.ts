import { describe, expect, it } from 'vitest';
import { blind, kick, push, unitVector } from './disturb';

describe('a direction', () => {
  it('is as drawn: x to the right, y up', () => {
    expect(unitVector('left', 0.3)).toEqual([-1, 0]);
    expect(unitVector('up', 0.3)).toEqual([0, 1]);
  });

  it('is any one when it is random', () => {
    expect(unitVector('random', 0.25)[1]).toBeCloseTo(1);
    for (const chance of [0, 0.1, 0.37, 0.99]) {
      expect(Math.hypot(...unitVector('random', chance))).toBeCloseTo(1);
    }
  });
});

describe('a disturbance', () => {
  it('is sent in newtons and seconds', () => {
    expect(kick(2, [1, 0])).toEqual({ impulse: { x_n_s: 0.002, y_n_s: 0 } });
    expect(push(3, 1.5, [0, -1])).toEqual({ drift: { x_n: 0, y_n: -0.003, for_s: 1.5 } });
    expect(blind(2)).toEqual({ dropout: { for_s: 2 } });
  });
});
