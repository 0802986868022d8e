import { describe, expect, it } from 'vitest';
import { chosenPad, DEAD_ZONE, readPad, stick } from './gamepad';

const pad = (axes: number[], pressed: number[] = []) => ({
  axes,
  buttons: Array.from({ length: 17 }, (_, index) => ({ pressed: pressed.includes(index) })),
});

describe('a stick', () => {
  it('rests in its dead zone and rises from zero at its edge to one', () => {
    expect(stick(0.1, -0.1)).toEqual([0, 0]);
    expect(stick(NaN, 0)).toEqual([0, 0]);
    expect(stick(DEAD_ZONE + 1e-6, 0)[0]).toBeCloseTo(0, 4);
    expect(stick(1, 0)).toEqual([1, -0]);
    const [x, y] = stick(1, -1);
    expect(Math.hypot(x, y)).toBeCloseTo(1);
    expect(y).toBeGreaterThan(0);
  });
});

describe('a gamepad', () => {
  it('gives its cross before its sticks, and holds with the first button', () => {
    expect(readPad(pad([1, 0], [12, 14]))).toEqual([-1, 1]);
    expect(readPad(pad([0, 0, 0, 1]))).toEqual([0, -1]);
    expect(readPad(pad([1, 0], [0]))).toBe('hold');
    expect(readPad({ axes: [], buttons: [] })).toEqual([0, 0]);
  });

  it('is the one that is used', () => {
    const [idle, used] = [pad([0.05, 0]), pad([0, -1])];
    expect(chosenPad([null, idle, used], readPad)).toBe(used);
    expect(chosenPad([null, idle], readPad)).toBe(idle);
    expect(chosenPad([null], readPad)).toBeUndefined();
  });
});
