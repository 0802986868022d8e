import { describe, expect, it } from 'vitest';
import { History } from './history';
import { stateAt } from './testing';

const ticks = (history: History): number[] => [
  ...(history.window(-Infinity, Infinity, ['tick'])[0] ?? []),
];

function filled(capacity: number, count: number): History {
  const history = new History(capacity);
  for (let tick = 0; tick < count; tick++) history.push(stateAt(tick));
  return history;
}

describe('History', () => {
  it('keeps the newest samples, in order, however many come', () => {
    for (const count of [3, 8, 9, 16, 17, 100]) {
      const kept = Math.min(8, count);
      expect(ticks(filled(8, count))).toEqual(
        Array.from({ length: kept }, (_, i) => count - kept + i),
      );
    }
  });

  it('cuts windows at both ends, ends included', () => {
    const [times, errors] = filled(100, 50).window(10 * 0.008, 20 * 0.008, [
      'sim_time_s',
      'error_m',
    ]);
    expect(times).toHaveLength(11);
    expect(errors?.[0]).toBe(20);
    expect(filled(100, 50).window(90, 100, ['tick'])[0]).toHaveLength(0);
  });

  it('stores nothing while it looks back', () => {
    const history = filled(100, 10);
    history.push(stateAt(4));
    expect(ticks(history)).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  });

  it('replaces the newest state by one of the same tick', () => {
    const history = filled(8, 20);
    history.push(stateAt(19, { bead_m: [7, 0, 0] }));
    expect(ticks(history)).toEqual([12, 13, 14, 15, 16, 17, 18, 19]);
    expect(history.window(0, 1, ['bead_x_m'])[0]?.at(-1)).toBe(7);
  });

  it('goes on from a tick that it was cut at', () => {
    const history = filled(100, 10);
    history.cutAfter(4);
    history.push(stateAt(5));
    expect(ticks(history)).toEqual([0, 1, 2, 3, 4, 5]);
    history.clear();
    expect(history.length).toBe(0);
  });

  it('is cut right also after it moved to the front', () => {
    const history = filled(8, 17);
    history.cutAfter(12);
    expect(ticks(history)).toEqual([9, 10, 11, 12]);
  });
});
