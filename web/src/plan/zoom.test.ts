import { describe, expect, it } from 'vitest';
import { fitView, pxFromWorld, worldFromPx } from './transform';
import { type Frame, WHOLE, panBy, zoomAt, zoomedView } from './zoom';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
const INSETS = { left: 40, right: 10, top: 10, bottom: 20 };
const FRAME: Frame = {
  width: 700,
  height: 400,
  fit: fitView(WORKSPACE, 700, 400, INSETS),
  workspace: WORKSPACE,
};

describe('the zoom', () => {
  it('keeps the place at the pointer', () => {
    const px = [500, 150] as const;
    const at = worldFromPx(FRAME.fit, px);
    const zoom = zoomAt(FRAME, WHOLE, px, 3);
    expect(zoom.factor).toBe(3);
    const now = pxFromWorld(zoomedView(FRAME, zoom), at);
    expect(now[0]).toBeCloseTo(px[0]);
    expect(now[1]).toBeCloseTo(px[1]);
  });

  it('ends with the whole workspace', () => {
    const zoom = zoomAt(FRAME, zoomAt(FRAME, WHOLE, [100, 100], 2), [600, 300], 0.1);
    expect(zoom).toBe(WHOLE);
    expect(zoomedView(FRAME, zoom)).toBe(FRAME.fit);
  });

  it('has a largest factor', () => {
    expect(zoomAt(FRAME, WHOLE, [350, 200], 1e6).factor).toBe(12);
  });

  it('moves with the pointer, and keeps the workspace in the middle', () => {
    const zoom = zoomAt(FRAME, WHOLE, [350, 200], 4);
    const moved = panBy(FRAME, zoom, [50, -20]);
    const before = pxFromWorld(zoomedView(FRAME, zoom), [0, -0.35]);
    const after = pxFromWorld(zoomedView(FRAME, moved), [0, -0.35]);
    expect(after[0] - before[0]).toBeCloseTo(50);
    expect(after[1] - before[1]).toBeCloseTo(-20);
    expect(panBy(FRAME, zoom, [1e6, 0]).middle_m[0]).toBe(WORKSPACE.x_min_m);
    expect(panBy(FRAME, WHOLE, [50, 0])).toBe(WHOLE);
  });
});
