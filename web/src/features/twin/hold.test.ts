import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createHold } from './hold';

describe('a button that is held', () => {
  beforeEach(() => {
    vi.useFakeTimers();
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it('is said to be held until it is released, more often than the server forgets', () => {
    const said: boolean[] = [];
    const hold = createHold((held) => said.push(held));
    hold.release();
    expect(said).toEqual([]);
    hold.press();
    hold.press();
    expect(said).toEqual([true]);
    vi.advanceTimersByTime(250);
    expect(said.length).toBeGreaterThanOrEqual(5);
    expect(said).not.toContain(false);
    hold.release();
    const { length } = said;
    expect(said.at(-1)).toBe(false);
    vi.advanceTimersByTime(1000);
    hold.release();
    expect(said).toHaveLength(length);
  });
});
