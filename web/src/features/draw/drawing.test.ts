import { expect, it } from 'vitest';
import {
  BLANK,
  type Mm,
  mirrored,
  moved,
  movedInside,
  pathText,
  shapeAt,
  type Shape,
  svgText,
  withImages,
} from './drawing';

const WALL: Shape = {
  kind: 'wall',
  points: [
    [-100, 300],
    [-100, 400],
  ],
  width_mm: 12,
};
const POST: Shape = { kind: 'post', center: [50, 300], radius_mm: 10 };
const RING: Shape = {
  kind: 'area',
  rings: [
    [
      [100, 300],
      [200, 300],
      [200, 400],
      [100, 400],
    ],
    [
      [120, 320],
      [180, 320],
      [180, 380],
      [120, 380],
    ],
  ],
};

it('is an SVG in millimetres with the frame as its view box', () => {
  const text = svgText({ ...BLANK, shapes: [WALL, POST, RING] });
  expect(text).toContain('viewBox="-300 210 580 330"');
  expect(text).toContain('<path d="M-100 300L-100 400" stroke-width="12" class="wall"/>');
  expect(text).toContain('<circle cx="50" cy="300" r="10"/>');
  expect(text).toContain('d="M100 300L200 300L200 400L100 400ZM120 320L180 320');
});

it('says when it is for the planar stage', () => {
  expect(svgText(BLANK)).not.toContain('data-positioner');
  const text = svgText({ ...BLANK, positioner: 'planar_stage' });
  expect(text).toContain(' data-positioner="planar-stage">');
});

it('draws a wall of one point as a dot, and rounds to a hundredth', () => {
  expect(pathText({ kind: 'wall', points: [[1.23456, 2]], width_mm: 5 })).toBe('M1.23 2L1.23 2');
});

it('mirrors about the middle of the frame, and back', () => {
  const { frame } = BLANK;
  expect(mirrored(POST, frame, 'sides')).toEqual({ ...POST, center: [-70, 300] });
  expect(mirrored(POST, frame, 'ends')).toEqual({ ...POST, center: [50, 450] });
  for (const shape of [WALL, POST, RING]) {
    expect(mirrored(mirrored(shape, frame, 'ends'), frame, 'ends')).toEqual(shape);
  }
});

it('repeats a shape on the other sides', () => {
  const centers = (symmetry: 'none' | 'sides' | 'ends' | 'both'): Mm[] =>
    withImages(POST, BLANK.frame, symmetry).flatMap((one) =>
      one.kind === 'post' ? [one.center] : [],
    );
  expect(centers('none')).toEqual([[50, 300]]);
  expect(centers('sides')).toEqual([
    [50, 300],
    [-70, 300],
  ]);
  expect(centers('ends')).toEqual([
    [50, 300],
    [50, 450],
  ]);
  expect(centers('both')).toEqual([
    [50, 300],
    [-70, 300],
    [50, 450],
    [-70, 450],
  ]);
});

it('does not repeat a shape on its own place', () => {
  const { frame } = BLANK;
  const middle: Shape = { kind: 'post', center: [-10, 375], radius_mm: 5 };
  expect(withImages(middle, frame, 'both')).toEqual([middle]);
  const across: Shape = {
    kind: 'wall',
    points: [
      [-60, 300],
      [40, 300],
    ],
    width_mm: 5,
  };
  expect(withImages(across, frame, 'sides')).toEqual([across]);
  expect(withImages(across, frame, 'both')).toHaveLength(2);
  const box: Shape = {
    kind: 'area',
    rings: [
      [
        [-60, 300],
        [40, 300],
        [40, 350],
        [-60, 350],
      ],
    ],
  };
  expect(withImages(box, frame, 'sides')).toEqual([box]);
  // The same corners, joined otherwise.
  const zed: Shape = {
    kind: 'wall',
    points: [
      [-60, 300],
      [40, 300],
      [-60, 450],
      [40, 450],
    ],
    width_mm: 5,
  };
  expect(withImages(zed, frame, 'sides')).toHaveLength(2);
});

it('keeps the middle of a moved shape in the frame', () => {
  expect(movedInside(POST, [1000, 0], BLANK.frame)).toMatchObject({ center: [280, 300] });
  expect(movedInside(WALL, [0, -1000], BLANK.frame)).toMatchObject({
    points: [
      [-100, 160],
      [-100, 260],
    ],
  });
});

it('finds the topmost shape at a point, but nothing in a hole', () => {
  const drawing = { ...BLANK, shapes: [WALL, POST, RING, moved(POST, [5, 0])] };
  expect(shapeAt(drawing, [-95, 350], 0)).toBe(0);
  expect(shapeAt(drawing, [-92, 350], 0)).toBeUndefined();
  expect(shapeAt(drawing, [-92, 350], 3)).toBe(0);
  expect(shapeAt(drawing, [-100, 407], 0)).toBeUndefined();
  expect(shapeAt(drawing, [50, 300], 0)).toBe(3);
  expect(shapeAt(drawing, [42, 300], 0)).toBe(1);
  expect(shapeAt(drawing, [110, 350], 0)).toBe(2);
  expect(shapeAt(drawing, [150, 350], 0)).toBeUndefined();
});
