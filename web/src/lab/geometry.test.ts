import { describe, expect, it } from 'vitest';
import { clampToRect, distanceToLine, insidePolygon, nextToward, placeAfter } from './geometry';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };

describe('rectangles', () => {
  it('clamp points outside and keep points inside', () => {
    expect(clampToRect(WORKSPACE, [1, -1])).toEqual([0.28, -0.54]);
    expect(clampToRect(WORKSPACE, [0.1, -0.3])).toEqual([0.1, -0.3]);
  });
});

describe('a way', () => {
  it('is gone from place to place, and stays at its end', () => {
    const at = (steps: number) =>
      placeAfter(
        [
          [1, 0],
          [2, 0],
          [3, 0],
        ],
        steps,
      )?.[0];
    expect([0, 0.5, 2, 2.5, Infinity].map(at)).toEqual([1, 1.5, 3, 3, 3]);
    expect(placeAfter([], 1)).toBeUndefined();
  });

  it('is as far as its nearest point', () => {
    expect(distanceToLine([1, 2], [0, 0], [4, 0])).toBe(2);
    expect(distanceToLine([7, 4], [0, 0], [4, 0])).toBe(5);
    expect(distanceToLine([3, 4], [0, 0], [0, 0])).toBe(5);
  });
});

describe('insidePolygon', () => {
  const ring: [number, number][] = [
    [0, 0],
    [4, 0],
    [4, 4],
    [0, 4],
  ];
  const hole: [number, number][] = [
    [1, 1],
    [1, 3],
    [3, 3],
    [3, 1],
  ];

  it('distinguishes inside, outside and hole', () => {
    const polygon = { exterior: ring, holes: [hole] };
    expect(insidePolygon(polygon, [0.5, 0.5])).toBe(true);
    expect(insidePolygon(polygon, [2, 2])).toBe(false);
    expect(insidePolygon(polygon, [5, 2])).toBe(false);
  });

  it('follows a concave outline', () => {
    const bay: [number, number][] = [
      [0, 0],
      [4, 0],
      [4, 4],
      [2, 1],
      [0, 4],
    ];
    expect(insidePolygon({ exterior: bay, holes: [] }, [2, 2])).toBe(false);
    expect(insidePolygon({ exterior: bay, holes: [] }, [0.3, 2])).toBe(true);
  });
});

it('finds the next place in a direction', () => {
  const places = [
    [0.01, 0],
    [0.02, 0],
    [0.03, 0],
    [0.03, 0.01],
  ] as const;
  expect(nextToward(places, places[0], [1, 0])).toBe(1);
  expect(nextToward(places, places[2], [0, 1])).toBe(3);
  expect(nextToward(places, places[0], [-1, 0])).toBeUndefined();
  // Across a gap, and a little beside.
  expect(nextToward([[0.2, 0.01]], places[0], [1, 0])).toBe(0);
});
