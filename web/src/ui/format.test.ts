import { describe, expect, it } from 'vitest';
import { axisLabel, centimetres, clock, duration, fixed, newtons, roughly, speed } from './format';

describe('readouts', () => {
  it('have a true minus sign, but not on zero', () => {
    expect(fixed(-1.25, 2)).toBe('\u22121.25');
    expect(fixed(-0.001, 2)).toBe('0.00');
    expect(centimetres(0.1234)).toBe('12.3 cm');
  });

  it('choose the unit of a force', () => {
    expect(newtons(0.0048)).toBe('4.8 mN');
    expect(newtons(1.2345)).toBe('1.23 N');
  });

  it('show minutes only from one minute', () => {
    expect(clock(0)).toBe('0.0 s');
    expect(clock(59.94)).toBe('59.9 s');
    expect(clock(59.96)).toBe('1:00.0');
    expect(clock(62.44)).toBe('1:02.4');
  });

  it('label an axis without rounding its halves', () => {
    expect([0, 2.5, 5, 7.5].map(axisLabel)).toEqual(['0', '2.5', '5', '7.5']);
  });

  it('name speeds as fractions and multiples', () => {
    expect([0.125, 0.5, 1, 8].map(speed)).toEqual(['1/8×', '1/2×', '1×', '8×']);
  });
});

describe('roughly', () => {
  it.each([
    [0, '1 s'],
    [3.2, '4 s'],
    [41, '45 s'],
    [56, '1 min'],
    [601, '11 min'],
    [3600, '1 h'],
    [4000, '1 h 7 min'],
  ])('%f s is %s', (time_s, text) => {
    expect(roughly(time_s)).toBe(text);
  });
});

it.each([
  [0, '0:00'],
  [0.008, '0:00'],
  [59.6, '1:00'],
  [62, '1:02'],
  [4503, '75:03'],
])('%d seconds are shown as %s', (seconds, text) => {
  expect(duration(seconds)).toBe(text);
});
