import { describe, expect, it } from 'vitest';
import { fitView, pxFromWorld, worldFromPx } from './transform';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
const INSETS = { left: 40, right: 10, top: 10, bottom: 20 };

describe('fitView', () => {
  it('shows the whole workspace inside the insets, with y up', () => {
    for (const [width, height] of [
      [700, 400],
      [300, 900],
      [1600, 200],
    ] as const) {
      const view = fitView(WORKSPACE, width, height, INSETS);
      const [left, top] = pxFromWorld(view, [WORKSPACE.x_min_m, WORKSPACE.y_max_m]);
      const [right, bottom] = pxFromWorld(view, [WORKSPACE.x_max_m, WORKSPACE.y_min_m]);
      expect(left).toBeGreaterThanOrEqual(INSETS.left - 1e-9);
      expect(top).toBeGreaterThanOrEqual(INSETS.top - 1e-9);
      expect(right).toBeLessThanOrEqual(width - INSETS.right + 1e-9);
      expect(bottom).toBeLessThanOrEqual(height - INSETS.bottom + 1e-9);
      expect((right - left) / (bottom - top)).toBeCloseTo(0.58 / 0.33, 9);
    }
  });

  it('is inverted by worldFromPx', () => {
    const view = fitView(WORKSPACE, 700, 400, INSETS);
    const [x, y] = worldFromPx(view, pxFromWorld(view, [0.123, -0.345]));
    expect(x).toBeCloseTo(0.123, 12);
    expect(y).toBeCloseTo(-0.345, 12);
  });

  it('works on a canvas of size zero', () => {
    expect(fitView(WORKSPACE, 0, 0, INSETS).pxPerM).toBeGreaterThan(0);
  });
});
