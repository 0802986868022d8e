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
    const said: (number | undefined)[] = [];
    const hold = createHold((press) => said.push(press));
    hold.release();
    expect(said).toEqual([]);
    hold.press();
    hold.press();
    expect(said).toHaveLength(1);
    const [first] = said;
    vi.advanceTimersByTime(250);
    expect(said.length).toBeGreaterThanOrEqual(5);
    expect(new Set(said)).toEqual(new Set([first]));
    expect(first).toBeGreaterThanOrEqual(0);
    hold.release();
    const { length } = said;
    expect(said.at(-1)).toBeUndefined();
    vi.advanceTimersByTime(1000);
    hold.release();
    expect(said).toHaveLength(length);
    hold.press();
    expect(said.at(-1)).not.toBe(first);
    hold.release();
  });
});
