import { describe, expect, it } from 'vitest';
import { blocksPath, type Homography, pictureFromTable, tableFromPicture } from './homography';

/** 480 px for 20 cm around (0.1, −0.3), seen vertically from above. */
const ABOVE: Homography = [
  [2400, 0, 0],
  [0, -2400, -480],
  [0, 0, 1],
];

describe('the picture of the table', () => {
  it('has +y up', () => {
    expect(pictureFromTable(ABOVE, [0.1, -0.3])).toEqual([240, 240]);
    const [, row] = pictureFromTable(ABOVE, [0.1, -0.25]);
    expect(row).toBeCloseTo(120);
  });

  it('divides by the depth', () => {
    const leaning: Homography = [ABOVE[0], ABOVE[1], [1, 0, 1]];
    expect(pictureFromTable(leaning, [0.1, -0.3])[0]).toBeCloseTo(240 / 1.1);
  });

  it('is NaN at the horizon', () => {
    const level: Homography = [ABOVE[0], ABOVE[1], [0, 0, 0]];
    expect(pictureFromTable(level, [0.1, -0.3])).toEqual([NaN, NaN]);
  });

  it('leads back to the table', () => {
    const leaning: Homography = [ABOVE[0], ABOVE[1], [1, 0.5, 1]];
    const [x_m, y_m] = tableFromPicture(leaning, pictureFromTable(leaning, [0.13, -0.28])) ?? [];
    expect(x_m).toBeCloseTo(0.13);
    expect(y_m).toBeCloseTo(-0.28);
    const level: Homography = [ABOVE[0], ABOVE[1], [0, 0, 0]];
    expect(tableFromPicture(level, [10, 10])).toBeUndefined();
  });

  it('shows blocks at their pixels', () => {
    const layer = { origin_m: [0, -0.2], pixel_m: 0.2 / 480, dark: [], free: [], rectangles: [] };
    const path = blocksPath(ABOVE, { ...layer, origin_m: [0, -0.2] }, [[10, 20, 30, 40]]);
    expect(path).toBe('M10.0 20.0L40.0 20.0L40.0 60.0L10.0 60.0Z');
  });
});
