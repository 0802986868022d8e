import { expect, it } from 'vitest';
import { draftFrom } from './draft';
import { BLANK, svgText } from './drawing';
import { markFaults, placesOf } from './marks';

const FOUND = {
  workspace: { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 },
  outlines: [
    {
      exterior: [
        [0, -0.4],
        [0.1, -0.4],
        [0.1, -0.3],
        [0, -0.3],
      ] as [number, number][],
      holes: [],
    },
  ],
};

it('are refused in a wall, nearer to one than the radius of the bead, and outside', () => {
  expect(markFaults({ start: [50, 350], goal: [-1, 350] }, FOUND)).toEqual([
    'The start is in a wall: place it elsewhere.',
    'The goal is in a wall: place it elsewhere.',
  ]);
  expect(markFaults({ start: [-3, 350], goal: [280, 350] }, FOUND)).toEqual([
    'The goal is in a wall: place it elsewhere.',
  ]);
  expect(markFaults({}, FOUND)).toEqual([]);
});

it('are in metres for the server, in the draft, and not in the SVG', () => {
  const marks = { start: [-100, 300], goal: [200, 400] } as const;
  expect(placesOf(marks)).toEqual({ start_m: [-0.1, -0.3], goal_m: [0.2, -0.4] });
  expect(placesOf({})).toEqual({});
  const drawing = { ...BLANK, marks };
  expect(draftFrom(JSON.stringify(drawing))).toEqual(drawing);
  const damaged = { ...BLANK, marks: { start: [1], goal: [200, 400] } };
  expect(draftFrom(JSON.stringify(damaged))?.marks).toEqual({ goal: [200, 400] });
  expect(svgText(drawing)).toBe(svgText(BLANK));
});
