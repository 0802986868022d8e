import { expect, it } from 'vitest';
import { farGoal } from './farGoal';

const workspace = { x_min_m: 0, x_max_m: 0.4, y_min_m: 0, y_max_m: 0.2 };
const box = (left: number, bottom: number, right: number, top: number) => ({
  exterior: [
    [left, bottom],
    [right, bottom],
    [right, top],
    [left, top],
  ] as [number, number][],
  holes: [],
});

it('is at the end of the longest way, not of the longest line', () => {
  const open = farGoal({ workspace, walls: [] }, [0.02, 0.02]);
  expect(open?.[0]).toBeGreaterThan(0.35);
  expect(open?.[1]).toBeGreaterThan(0.15);
  // A wall with its door at the right: the end of the way is above the bead.
  const walls = [box(0, 0.09, 0.34, 0.11)];
  const around = farGoal({ workspace, walls }, [0.02, 0.02]);
  expect(around?.[0]).toBeLessThan(0.05);
  expect(around?.[1]).toBeGreaterThan(0.12);
});

it('stays in the part of the bead, and needs room', () => {
  const walls = [box(0.19, 0, 0.21, 0.2)];
  expect(farGoal({ workspace, walls }, [0.02, 0.02])?.[0]).toBeLessThan(0.19);
  expect(farGoal({ workspace, walls: [box(0, 0, 0.4, 0.2)] }, [0.1, 0.1])).toBeUndefined();
});
