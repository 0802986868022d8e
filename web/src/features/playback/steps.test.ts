import { describe, expect, it } from 'vitest';
import {
  lateWords,
  limitWords,
  lostWords,
  nextSpeed,
  speedName,
  ticksToControlStep,
} from './steps';

describe('speeds', () => {
  it('go up and down by one step, within the limits', () => {
    expect(nextSpeed(1, 1)).toBe(2);
    expect(nextSpeed(1, -1)).toBe(0.5);
    expect(nextSpeed(3, 1)).toBe(4);
    expect(nextSpeed(64, 1)).toBe(64);
    expect(nextSpeed(0.125, -1)).toBe(0.125);
  });

  it('are named', () => {
    expect(speedName(64)).toBe('64× max');
    expect(speedName(0.125)).toBe('1/8×');
  });

  it('are shown when the machine is at its limit', () => {
    expect(limitWords(1, 0.97)).toBeUndefined();
    // The simulation has just started to run.
    expect(limitWords(8, 0)).toBeUndefined();
    expect(limitWords(1, 0.5)).toBe('only 0.50×');
    expect(limitWords(64, 21.04)).toBe('only 21.0×');
  });
});

describe('a control step', () => {
  it('is due at the first tick at or after each quarter of a second', () => {
    let tick = 0;
    const due: number[] = [];
    for (let step = 0; step < 5; step++) {
      tick += ticksToControlStep(tick, 0.008);
      due.push(tick);
    }
    // 31.25 ticks per control step.
    expect(due).toEqual([32, 63, 94, 125, 157]);
    expect(ticksToControlStep(40, 0.008)).toBe(23);
  });
});

it('mentions late ticks and lost time only if there are any', () => {
  expect(lateWords(20)).toBeUndefined();
  expect(lateWords(33.6)).toBe('34 ms late');
  expect(lostWords(0)).toBeUndefined();
  expect(lostWords(1)).toBe('fell behind once');
  expect(lostWords(12)).toBe('fell behind 12 times');
});
