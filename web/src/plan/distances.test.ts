import { expect, test } from 'vitest';
import { distancesFrom } from './distances';

test('each pixel has its distance from the nearest set one', () => {
  const [columns, rows] = [9, 7];
  const set = [3 + 2 * columns, 8 + 6 * columns];
  const distances = distancesFrom((pixel) => set.includes(pixel), columns, rows);
  distances.forEach((distance, pixel) => {
    const [x, y] = [pixel % columns, Math.floor(pixel / columns)];
    const nearest = Math.min(Math.hypot(x - 3, y - 2), Math.hypot(x - 8, y - 6));
    expect(distance).toBeCloseTo(nearest);
  });
});
