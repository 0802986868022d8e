import { describe, expect, it } from 'vitest';
import { MovedWalls } from '../lab/movedWalls';
import { lumenOf } from '../lab/testing';
import { TRAY_UP_M } from './tray';
import { WallEdges } from './wallEdges';

const FAR = { at_m: [9, 9], radius_m: 0.0025 } as const;
/** A room of 10 × 10 cm with a vertex every 5 mm. */
const ROOM = Array.from({ length: 80 }, (_, i): readonly [number, number] => {
  const [side, share] = [Math.floor(i / 20), (i % 20) / 200];
  const corners = [
    [share, 0],
    [0.1, share],
    [0.1 - share, 0.1],
    [0, 0.1 - share],
  ] as const;
  return corners[side] ?? [0, 0];
});

function edgesOf(closing_m: number) {
  const walls = new MovedWalls(lumenOf([ROOM]));
  walls.move([closing_m, closing_m], FAR);
  const edges = new WallEdges(walls);
  edges.update();
  const ends = Array.from({ length: edges.count }, (_, i) => [
    ...edges.ends.slice(3 * i, 3 * i + 3),
  ]);
  const lines = ends.flatMap((end, i) => (i % 2 === 0 ? [[end, ends[i + 1] ?? []]] : []));
  const length_m = lines
    .map(([a = [], b = []]) => Math.hypot((a[0] ?? 0) - (b[0] ?? 0), (a[1] ?? 0) - (b[1] ?? 0)))
    .reduce((sum, length) => sum + length, 0);
  return { ends, length_m };
}

describe('the edges of moved walls', () => {
  it('run around the room at the height of the walls', () => {
    const { ends, length_m } = edgesOf(0);
    expect(length_m).toBeCloseTo(0.4, 6);
    for (const [, , z] of ends) expect(z).toBeCloseTo(TRAY_UP_M, 6);
  });

  it('leave out what lies inside the walls', () => {
    const { ends, length_m } = edgesOf(0.02);
    // Of 60 mm on each side, without the loops in the corners.
    expect(length_m).toBeGreaterThan(0.2395);
    expect(length_m).toBeLessThan(0.2405);
    for (const [x = 0, y = 0] of ends) {
      expect(Math.min(x, y, 0.1 - x, 0.1 - y)).toBeGreaterThan(0.0195);
    }
  });
});
