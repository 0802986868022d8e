import { expect, test } from 'vitest';
import { floorMargins } from './floorPicture';

test('the margins for the numbers grow with the workspace, like the numbers', () => {
  const small = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
  const large = { x_min_m: -1, x_max_m: 1, y_min_m: 0, y_max_m: 1 };
  const margins = floorMargins(small);
  expect(margins.left).toBeCloseTo((40 / 460) * 0.58);
  expect(floorMargins(large).bottom / margins.bottom).toBeCloseTo(2 / 0.58);
});
