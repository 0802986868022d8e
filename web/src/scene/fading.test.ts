import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { type Fade, covers, FADED, faded, isSettled, SOLID } from './fading';

const run = (from: Fade, isCovering: boolean, ms: number, jumps = false): Fade => {
  let fade = from;
  for (let i = 0; i < ms / 10; i++) fade = faded(fade, isCovering, 10, jumps);
  return fade;
};

describe('the fading of a link', () => {
  it('takes 200 ms', () => {
    expect(run(SOLID, true, 100).opacity).toBeCloseTo((1 + FADED) / 2, 6);
    const end = run(SOLID, true, 200);
    expect(end.opacity).toBeCloseTo(FADED, 6);
    expect(isSettled(run(end, true, 10), true)).toBe(true);
  });

  it('begins to go back after 400 ms without cover', () => {
    const low = run(SOLID, true, 210);
    expect(run(low, false, 390).opacity).toBe(FADED);
    expect(isSettled(run(low, false, 390), false)).toBe(false);
    expect(run(low, false, 500).opacity).toBeGreaterThan(FADED);
    expect(isSettled(run(low, false, 610), false)).toBe(true);
    // A short look at the place does not count.
    const again = faded(run(low, false, 390), true, 10);
    expect(run(again, false, 390).opacity).toBe(FADED);
  });

  it('jumps where less motion is wanted', () => {
    expect(faded(SOLID, true, 0, true).opacity).toBe(FADED);
    expect(run(faded(SOLID, true, 0, true), false, 390, true).opacity).toBe(FADED);
    expect(run(faded(SOLID, true, 0, true), false, 400, true).opacity).toBe(1);
  });

  it('is at rest while nothing is covered', () => {
    expect(isSettled(SOLID, false)).toBe(true);
    expect(isSettled(SOLID, true)).toBe(false);
  });
});

describe('a rod', () => {
  const [eye, at] = [new Vector3(0, -2, 0), new Vector3(0, 0, 0)];
  const rod = (x: number, y: number) => ({
    from: new Vector3(x, y, -1),
    to: new Vector3(x, y, 1),
    radius_m: 0.05,
  });

  it('covers what lies behind it, and the ring around that', () => {
    expect(covers(rod(0, -1), eye, at, 0)).toBe(true);
    expect(covers(rod(0.04, -1), eye, at, 0)).toBe(true);
    expect(covers(rod(0.06, -1), eye, at, 0)).toBe(false);
    expect(covers(rod(0.06, -1), eye, at, 0.02)).toBe(true);
    expect(covers(rod(0.08, -1), eye, at, 0.02)).toBe(false);
  });

  it('covers nothing before it or behind the eye', () => {
    expect(covers(rod(0, 0.2), eye, at, 0.01)).toBe(false);
    expect(covers(rod(0, -2.2), eye, at, 0.01)).toBe(false);
  });

  it('covers nothing beyond its ends', () => {
    const short = { from: new Vector3(0, -1, 0.2), to: new Vector3(0, -1, 1), radius_m: 0.05 };
    expect(covers(short, eye, at, 0.01)).toBe(false);
    expect(covers({ ...short, to: short.from, radius_m: 0.3 }, eye, at, 0)).toBe(true);
  });
});
