import { PerspectiveCamera, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { distanceFor, hidingAt, turnedArrow, viewpointOf, VIEWPOINTS } from './viewpoints';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };

test('every viewpoint shows all of its bounds, and they fill the picture', () => {
  for (const name of VIEWPOINTS) {
    for (const aspect of [0.6, 1, 1.8, 3]) {
      const viewpoint = viewpointOf(name, WORKSPACE);
      const camera = new PerspectiveCamera(38, aspect, 0.01, 10);
      camera.up.set(0, 0, 1);
      const target = new Vector3(...viewpoint.target_m);
      const away = distanceFor(viewpoint, (38 * Math.PI) / 180, aspect);
      camera.position
        .set(...viewpoint.toCamera)
        .setLength(away)
        .add(target);
      camera.lookAt(target);
      camera.updateMatrixWorld();
      const reaches = viewpoint.bounds_m.map((bound) => {
        const at = new Vector3(...bound).project(camera);
        return Math.max(Math.abs(at.x), Math.abs(at.y));
      });
      expect(Math.max(...reaches), `${name} at ${aspect}`).toBeLessThan(1);
      expect(Math.max(...reaches), `${name} at ${aspect}`).toBeGreaterThan(0.9);
    }
  }
});

test('an arrow key moves the cursor along the arrow on the screen', () => {
  // From the front, the arrows are as in the plan view. From +x, +y is to the right.
  const [quarter, up, right] = [Math.PI / 2, [0, 1], [1, 0]] as const;
  expect(turnedArrow(up, 0.3)).toEqual([0, 1]);
  expect(turnedArrow(up, quarter).map(Math.round)).toEqual([-1, 0]);
  expect(turnedArrow(right, quarter).map((n) => n + 0)).toEqual([0, 1]);
  expect(turnedArrow(right, -quarter).map((n) => n + 0)).toEqual([0, -1]);
  expect(turnedArrow(up, 2 * quarter).map((n) => n + 0)).toEqual([0, -1]);
});

test('the arm is more transparent from above and opaque from the side', () => {
  expect(hidingAt(0)).toBeLessThan(0.25);
  expect(hidingAt(0.45)).toBeGreaterThan(hidingAt(0.35));
  expect(hidingAt(Math.PI / 3)).toBe(1);
});
