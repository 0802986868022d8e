import { describe, expect, it } from 'vitest';
import { fitView, pxFromWorld } from './transform';
import { gridStepM } from './drawMap';
import { beadRadiusPx } from './drawMoving';
import { GRAB_PX } from './input';

/** The planar stage's table on the canvas of a small screen, with axes. */
const TABLE = { x_min_m: -1, x_max_m: 1, y_min_m: -0.5, y_max_m: 0.5 };
const WIDTH_PX = 706;
const HEIGHT_PX = 384;
const INSETS = { left: 46, right: 12, top: 12, bottom: 24 };
const BEAD_RADIUS_M = 0.0025;
const CAPTURE_M = 0.0947;

describe('a table of two metres by one', () => {
  const view = fitView(TABLE, WIDTH_PX, HEIGHT_PX, INSETS);

  it('fills the width of the canvas beside the axes', () => {
    const [left, top] = pxFromWorld(view, [TABLE.x_min_m, TABLE.y_max_m]);
    const [right, bottom] = pxFromWorld(view, [TABLE.x_max_m, TABLE.y_min_m]);
    expect(left).toBeCloseTo(INSETS.left);
    expect(right).toBeCloseTo(WIDTH_PX - INSETS.right);
    expect(top).toBeGreaterThanOrEqual(INSETS.top);
    expect(bottom).toBeLessThanOrEqual(HEIGHT_PX - INSETS.bottom);
  });

  it('has a grid whose numbers do not overlap', () => {
    expect(gridStepM(view.pxPerM)).toBe(0.2);
  });

  it('shows the bead enlarged, and a capture ring wider than the grab distance', () => {
    expect(BEAD_RADIUS_M * view.pxPerM).toBeLessThan(1);
    expect(beadRadiusPx(view, BEAD_RADIUS_M)).toBeGreaterThanOrEqual(4);
    expect(CAPTURE_M * view.pxPerM).toBeGreaterThan(1.5 * GRAB_PX.mouse);
  });
});
