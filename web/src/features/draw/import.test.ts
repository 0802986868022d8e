import { expect, it } from 'vitest';
import { BLANK } from './drawing';
import { draftFrom } from './draft';
import { drawingOf } from './import';

it('turns the walls of a map into areas, in millimetres and y down', () => {
  const workspace = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
  const exterior: [number, number][] = [
    [0.1, -0.3],
    [0.2, -0.3],
    [0.2, -0.4],
  ];
  const drawing = drawingOf({
    positioner: 'planar_stage',
    workspace,
    outlines: [
      {
        exterior,
        holes: [
          [
            [0.15, -0.33],
            [0.16, -0.33],
            [0.16, -0.34],
          ],
        ],
      },
    ],
  });
  expect(drawing).toMatchObject({ frame: BLANK.frame, positioner: 'planar_stage' });
  expect(drawing.shapes).toEqual([
    {
      kind: 'area',
      rings: [
        [
          [100, 300],
          [200, 300],
          [200, 400],
        ],
        [
          [150, 330],
          [160, 330],
          [160, 340],
        ],
      ],
    },
  ]);
});

it('goes on with a stored drawing, and drops a damaged one', () => {
  const shapes = [
    { kind: 'wall', points: [[0, 300]], width_mm: 12 },
    { kind: 'post', center: [0, 1], radius_mm: 3 },
    {
      kind: 'area',
      rings: [
        [
          [0, 1],
          [2, 3],
          [4, 5],
        ],
      ],
    },
  ];
  const text = JSON.stringify({ ...BLANK, shapes });
  expect(draftFrom(text)).toEqual({ ...BLANK, shapes });
  const damaged = [
    null,
    '',
    '{}',
    'null',
    text.slice(0, -3),
    text.replace('12', '"12"'),
    text.replace('[0,1]', '[0]'),
    text.replace('580', 'null'),
  ];
  for (const one of damaged) expect(draftFrom(one)).toBeUndefined();
});
