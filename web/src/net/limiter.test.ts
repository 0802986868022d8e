import { describe, expect, it } from 'vitest';
import { Limiter } from './limiter';
import { manualClock } from './testing';

describe('Limiter', () => {
  it('sends the first value at once and then the newest of each interval', () => {
    const clock = manualClock();
    const sent: number[] = [];
    const limiter = new Limiter<number>(10, (value) => sent.push(value), clock);
    limiter.offer(1);
    limiter.offer(2);
    limiter.offer(3);
    expect(sent).toEqual([1]);
    clock.advance(10);
    expect(sent).toEqual([1, 3]);
    clock.advance(50);
    expect(sent).toEqual([1, 3]);
  });

  it('never exceeds its rate and never loses the last value', () => {
    const clock = manualClock();
    const sent: number[] = [];
    const limiter = new Limiter<number>(1000 / 60, (value) => sent.push(value), clock);
    for (let i = 0; i < 1000; i++) {
      limiter.offer(i);
      clock.advance(1);
    }
    clock.advance(100);
    expect(sent.length).toBeLessThanOrEqual(61);
    expect(sent.length).toBeGreaterThan(50);
    expect(sent.at(-1)).toBe(999);
  });

  it('sends a waiting value once when it is flushed', () => {
    const clock = manualClock();
    const sent: number[] = [];
    const limiter = new Limiter<number>(10, (value) => sent.push(value), clock);
    limiter.offer(1);
    limiter.offer(2);
    limiter.flush();
    clock.advance(20);
    expect(sent).toEqual([1, 2]);
  });
});
