import { describe, expect, it } from 'vitest';
import { fitView, pxFromWorld } from './transform';
import { gridStepM } from './drawMap';
import { framed } from './tray';
import { beadRadiusPx } from './drawMoving';
import { GRAB_PX } from './input';

/** The planar stage's table on the canvas of a small screen. */
const TABLE = { x_min_m: -1, x_max_m: 1, y_min_m: -0.5, y_max_m: 0.5 };
const WIDTH_PX = 706;
const HEIGHT_PX = 384;
const BEAD_RADIUS_M = 0.0025;
const CAPTURE_M = 0.0947;

describe('a table of two metres by one', () => {
  const view = fitView(framed(TABLE), WIDTH_PX, HEIGHT_PX);

  it('fills the width of the canvas but for the frame of the tray', () => {
    const [left, top] = pxFromWorld(view, [TABLE.x_min_m, TABLE.y_max_m]);
    const [right, bottom] = pxFromWorld(view, [TABLE.x_max_m, TABLE.y_min_m]);
    expect(left).toBeGreaterThan(4);
    expect(left).toBeLessThan(10);
    expect(right).toBeCloseTo(WIDTH_PX - left);
    expect(top).toBeGreaterThan(4);
    expect(bottom).toBeLessThan(HEIGHT_PX - 4);
  });

  it('has a grid whose numbers do not overlap', () => {
    expect(gridStepM(view.pxPerM)).toBe(0.2);
  });

  it('shows the bead enlarged, and a capture ring wider than the grab distance', () => {
    expect(BEAD_RADIUS_M * view.pxPerM).toBeLessThan(1);
    expect(beadRadiusPx(view, BEAD_RADIUS_M)).toBeGreaterThanOrEqual(4);
    expect(CAPTURE_M * view.pxPerM).toBeGreaterThan(1.4 * GRAB_PX.mouse);
  });
});
