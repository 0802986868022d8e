import { describe, expect, it } from 'vitest';
import { clampToRect, insidePolygon, nextToward } from './geometry';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };

describe('rectangles', () => {
  it('clamp points outside and keep points inside', () => {
    expect(clampToRect(WORKSPACE, [1, -1])).toEqual([0.28, -0.54]);
    expect(clampToRect(WORKSPACE, [0.1, -0.3])).toEqual([0.1, -0.3]);
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
