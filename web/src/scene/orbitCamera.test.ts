import { expect, test } from 'vitest';
import type { Vec2 } from '../lab/geometry';
import { OrbitCamera } from './orbitCamera';
import { fitView, tableViewOf } from '../plan/transform';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
const [WIDTH, HEIGHT] = [800, 400];

function opened() {
  let changes = 0;
  const orbit = new OrbitCamera(() => {
    changes += 1;
  });
  orbit.lookAt(WORKSPACE);
  orbit.resize(WIDTH, HEIGHT);
  const at = (point: Vec2): Vec2 => orbit.view().view.toPx(point) ?? [NaN, NaN];
  const under = (px: Vec2): Vec2 => orbit.view().view.toWorld(px) ?? [NaN, NaN];
  return { orbit, at, under, changes: () => changes };
}
const drag = (from: Vec2, to: Vec2, grip: 'turn' | 'shift' | 'dolly') =>
  ({ type: 'move', from, to, press: from, grip }) as const;
const scaleAt = ({ at }: ReturnType<typeof opened>): number =>
  at([0.1, -0.4])[0] - at([0, -0.4])[0];

test('the first viewpoint looks from the front, and a turn by half the height is half a round', () => {
  const view = opened();
  const back: Vec2 = [0.1, 0];
  const front = view.orbit.turned([1, 0]);
  expect(front).toEqual([1, 0]);
  view.orbit.move(drag([0, 0], [HEIGHT / 2, 0], 'turn'));
  const turned = view.orbit.turned([1, 0]);
  expect(turned.map(Math.round).map((one) => one + 0)).toEqual([-1, 0]);
  expect(view.at(back)).not.toContain(NaN);
});

test('the table is not seen from below', () => {
  const { orbit } = opened();
  orbit.move(drag([0, 0], [0, -10 * HEIGHT], 'turn'));
  expect(orbit.camera.position.z).toBeGreaterThan(0);
  orbit.move(drag([0, 0], [0, 10 * HEIGHT], 'turn'));
  // Exactly above: objects over the table are hidden.
  expect(orbit.hiding()).toBeLessThan(0.2);
});

test('wheel and fingers zoom at their place, between two distances', () => {
  const view = opened();
  const px: Vec2 = [520, 260];
  const before = view.under(px);
  const scale = scaleAt(view);
  expect(view.orbit.wheel({ ctrlKey: false }, -400, px)).toBe(true);
  expect(scaleAt(view)).toBeGreaterThan(1.1 * scale);
  expect(view.at(before)[0]).toBeCloseTo(px[0], -1);
  expect(view.at(before)[1]).toBeCloseTo(px[1], -1);
  const near = scaleAt(view);
  view.orbit.pinch({ type: 'pinch', from: [500, 200], to: [600, 200], other: [400, 200] });
  expect(scaleAt(view)).toBeGreaterThan(1.3 * near);
  for (let i = 0; i < 100; i++) view.orbit.wheel({ ctrlKey: false }, 1000, px);
  expect(view.orbit.camera.position.length()).toBeLessThan(10);
});

test('a shift moves the picture with the pointer', () => {
  const view = opened();
  view.orbit.take('Top');
  const [x, y] = view.at([0, -0.4]);
  view.orbit.move(drag([100, 100], [130, 80], 'shift'));
  const [x2, y2] = view.at([0, -0.4]);
  expect([x2 - x, y2 - y].map(Math.round)).toEqual([30, -20]);
});

test('a viewpoint follows the size of the picture until the view is moved', () => {
  const view = opened();
  const before = scaleAt(view);
  view.orbit.resize(WIDTH / 2, HEIGHT / 2);
  expect(scaleAt(view)).toBeLessThan(0.6 * before);
  view.orbit.resize(WIDTH, HEIGHT);
  view.orbit.key('[');
  const { z } = view.orbit.camera.position;
  view.orbit.resize(WIDTH / 2, HEIGHT);
  expect(view.orbit.camera.position.z).toBe(z);
  expect(view.orbit.key('Home')).toBe(true);
  expect(view.orbit.key('x')).toBe(false);
  expect(view.changes()).toBeGreaterThan(3);
});

const PLAN = {
  ...tableViewOf(fitView(WORKSPACE, WIDTH, HEIGHT, { left: 46, right: 12, top: 12, bottom: 24 })),
  size: { width: WIDTH, height: HEIGHT },
};
const CORNERS: readonly Vec2[] = [
  [-0.3, -0.54],
  [0.28, -0.21],
];

function fromPlan(jumps: boolean) {
  const orbit = new OrbitCamera(
    () => undefined,
    { shift: 0 },
    () => jumps,
    PLAN,
  );
  orbit.lookAt(WORKSPACE);
  orbit.resize(WIDTH, HEIGHT);
  const isPlan = (): boolean =>
    CORNERS.every((corner) => {
      const [x, y] = orbit.view().view.toPx(corner) ?? [NaN, NaN];
      const [planX, planY] = PLAN.toPx(corner) ?? [NaN, NaN];
      return Math.hypot(x - planX, y - planY) < 0.5;
    });
  const home = opened();
  const isHome = (): boolean =>
    CORNERS.every((corner) => {
      const [x, y] = orbit.view().view.toPx(corner) ?? [NaN, NaN];
      const [homeX, homeY] = home.at(corner);
      return Math.hypot(x - homeX, y - homeY) < 0.5;
    });
  return { orbit, isPlan, isHome };
}

test('the camera flies from the picture of the plan view to the home viewpoint, and back', () => {
  const { orbit, isPlan, isHome } = fromPlan(false);
  expect(isPlan()).toBe(true);
  expect(orbit.advance(160)).toBe(true);
  expect(isPlan() || isHome()).toBe(false);
  expect(orbit.advance(160)).toBe(false);
  expect(isHome()).toBe(true);
  expect(orbit.viewpoint).toBe('Home');

  let landings = 0;
  orbit.leave(PLAN, () => {
    landings += 1;
  });
  expect(orbit.advance(310)).toBe(true);
  expect(landings).toBe(0);
  expect(orbit.advance(10)).toBe(false);
  expect(landings).toBe(1);
  expect(isPlan()).toBe(true);
});

test('the camera jumps where less motion is wanted', () => {
  const { orbit, isPlan, isHome } = fromPlan(true);
  expect(isHome()).toBe(true);
  expect(orbit.advance(16)).toBe(false);
  let landings = 0;
  orbit.leave(PLAN, () => {
    landings += 1;
  });
  expect(landings).toBe(1);
  expect(isPlan()).toBe(true);
});

test('the user ends a flight by moving the view', () => {
  const { orbit } = fromPlan(false);
  orbit.advance(100);
  orbit.move(drag([0, 0], [20, 10], 'turn'));
  expect(orbit.advance(16)).toBe(false);
  expect(orbit.viewpoint).toBeUndefined();
});
