import { describe, expect, it } from 'vitest';
import { History } from './history';
import { stateAt } from './testing';

const ticks = (history: History): number[] => [...history.window(-Infinity, Infinity).tick];

function filled(capacity: number, count: number): History {
  const history = new History(capacity);
  for (let tick = 0; tick < count; tick++) history.push(stateAt(tick));
  return history;
}

describe('History', () => {
  it('keeps every sample while there is room', () => {
    expect(ticks(filled(8, 8))).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
  });

  it('covers the whole trial, complete at the end and coarser before', () => {
    const kept = ticks(filled(64, 10_000));
    expect(kept.length).toBeLessThanOrEqual(64);
    expect(kept[0]).toBe(0);
    expect(kept.slice(-9)).toEqual([9991, 9992, 9993, 9994, 9995, 9996, 9997, 9998, 9999]);
    const gaps = kept.slice(1).map((tick, index) => tick - (kept[index] ?? 0));
    expect(Math.min(...gaps)).toBe(1);
    // No gaps: old samples are evenly thinned out.
    expect(Math.max(...gaps)).toBeLessThan(1024);
  });

  it('has the bead position before a disturbance', () => {
    const history = filled(100, 10);
    expect(history.before(5, 'bead_x_m')).toBe(-4);
    expect(history.before(0, 'bead_x_m')).toBe(-0);
    expect(history.newest_s).toBeCloseTo(0.072);
  });

  it('returns a window that includes both of its ends', () => {
    const { sim_time_s, error_m } = filled(100, 50).window(10 * 0.008, 20 * 0.008);
    expect(sim_time_s).toHaveLength(11);
    expect(error_m[0]).toBe(20);
    expect(filled(100, 50).window(90, 100).tick).toHaveLength(0);
  });

  it('stores no state that is older than the newest one', () => {
    const history = filled(100, 10);
    history.push(stateAt(4));
    expect(ticks(history)).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  });

  it('replaces the newest state by one of the same tick', () => {
    const history = filled(30, 20);
    history.push(stateAt(19, { bead_m: [7, 0, 0] }));
    expect(ticks(history)).toHaveLength(20);
    expect(history.window(0, 1).bead_x_m.at(-1)).toBe(7);
  });

  it('continues from the tick at which it was cut', () => {
    const history = filled(100, 10);
    history.cutAfter(4);
    history.push(stateAt(5));
    expect(ticks(history)).toEqual([0, 1, 2, 3, 4, 5]);
    history.clear();
    expect(history.length).toBe(0);
  });

  it('can be cut between thinned samples', () => {
    const history = filled(16, 100);
    const before = ticks(history);
    history.cutAfter(60);
    expect(ticks(history)).toEqual(before.filter((tick) => tick <= 60));
    history.push(stateAt(61));
    expect(ticks(history).at(-1)).toBe(61);
  });
});
