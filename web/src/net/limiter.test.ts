import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Limiter } from './limiter';

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

describe('Limiter', () => {
  it('sends the first value at once and then the newest of each interval', () => {
    const sent: number[] = [];
    const limiter = new Limiter<number>(10, (value) => sent.push(value));
    limiter.offer(1);
    limiter.offer(2);
    limiter.offer(3);
    expect(sent).toEqual([1]);
    vi.advanceTimersByTime(10);
    expect(sent).toEqual([1, 3]);
    vi.advanceTimersByTime(50);
    expect(sent).toEqual([1, 3]);
  });

  it('never exceeds its rate and never loses the last value', () => {
    const sent: number[] = [];
    const limiter = new Limiter<number>(20, (value) => sent.push(value));
    for (let i = 0; i < 1000; i++) {
      limiter.offer(i);
      vi.advanceTimersByTime(1);
    }
    vi.advanceTimersByTime(100);
    expect(sent.length).toBeLessThanOrEqual(1100 / 20 + 1);
    expect(sent.length).toBeGreaterThan(48);
    expect(sent.at(-1)).toBe(999);
  });

  it('sends a waiting value once when it is flushed', () => {
    const sent: number[] = [];
    const limiter = new Limiter<number>(10, (value) => sent.push(value));
    limiter.offer(1);
    limiter.offer(2);
    limiter.flush();
    vi.advanceTimersByTime(20);
    expect(sent).toEqual([1, 2]);
  });
});
