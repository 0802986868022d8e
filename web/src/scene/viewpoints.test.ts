import { Matrix4, PerspectiveCamera, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { type Ball, ballsAt, jointsAt } from './reach';
import { type Lens, hidingAt, seatOf, stageOf, turnedArrow, VIEWPOINTS } from './viewpoints';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
const STAGE = stageOf(WORKSPACE, true);
const ALL = [...STAGE.tray, ...STAGE.holder];
type Triple = [number, number, number];
const FIELD_DEG = 28;
const TANGENT = Math.tan((FIELD_DEG * Math.PI) / 360);
/** The stages of the page at 1280 × 800, 1440 × 900 and 1920 × 1080, of a tablet and of a phone. */
const STAGES_PX = [
  [868, 648],
  [1004, 748],
  [1444, 928],
  [744, 560],
  [390, 672],
] as const;

function cameraOf(name: (typeof VIEWPOINTS)[number], aspect: number, shift = 0) {
  const lens: Lens = { tangent: TANGENT, aspect, shift };
  const { target_m, toCamera_m } = seatOf(name, STAGE, lens);
  const camera = new PerspectiveCamera(FIELD_DEG, aspect, 0.01, 20);
  const [width, height] = [1000 * aspect, 1000];
  camera.setViewOffset(width, height, -shift * width, 0, width, height);
  camera.up.set(0, 0, 1);
  const target = new Vector3(...target_m);
  camera.position.set(...toCamera_m).add(target);
  camera.lookAt(target);
  camera.updateMatrixWorld();
  return camera;
}

/** The farthest that balls reach from the middle of the picture; its edge is at 1. */
function farthest(camera: PerspectiveCamera, balls: readonly Ball[]): number {
  const axes = [0, 1].map((i) => new Vector3().setFromMatrixColumn(camera.matrixWorld, i));
  const end = new Vector3();
  let most = 0;
  for (const { at, radius_m } of balls) {
    for (const axis of axes) {
      for (const by of [-radius_m, radius_m]) {
        const { x, y } = end.copy(at).addScaledVector(axis, by).project(camera);
        most = Math.max(most, Math.abs(x), Math.abs(y));
      }
    }
  }
  return most;
}

/** Width of the tray, as a share of the picture's. */
function trayWidth(camera: PerspectiveCamera): number {
  const xs = STAGE.tray.map(({ at }) => at.clone().project(camera).x);
  return (Math.max(...xs) - Math.min(...xs)) / 2;
}

test('the joint angles are those that the server moves the arm to', () => {
  const joints = jointsAt([0.19, -0.28, 0.1]) ?? [];
  const server = [-0.64615615, -1.22062989, -2.24816761, -1.24359148, 1.57079633, -0.64615615];
  joints.forEach((angle, i) => {
    expect(angle).toBeCloseTo(server[i] ?? NaN, 6);
  });
  expect(jointsAt([0.9, -0.9, 0.1])).toBeUndefined();
});

test('the arm is in the picture of every viewpoint over all reachable places', () => {
  const frames = Array.from({ length: 6 }, () => new Matrix4());
  const poses = Array.from({ length: 60 }, (_, i) => {
    // Spread over the workspace, off the places that the camera was fitted to.
    const [x, y, z] = [0.618034 * i, 0.754878 * i, 0.56984 * i].map((n) => n % 1) as Triple;
    return jointsAt([-0.3 + 0.58 * x, -0.54 + 0.33 * y, 0.09 + 0.11 * z]);
  }).filter((joints_rad) => joints_rad !== undefined);
  expect(poses.length).toBeGreaterThan(40);
  const balls = poses.flatMap((joints_rad) => [...ballsAt(joints_rad, frames)]);
  for (const [width, height] of STAGES_PX) {
    for (const name of ['Home', 'Front', 'Side'] as const) {
      const camera = cameraOf(name, width / height);
      expect(farthest(camera, balls), `${name}, ${width} × ${height}`).toBeLessThan(1);
    }
  }
});

test('the tray is large, and what limits its size reaches the edge of the picture', () => {
  for (const [width, height] of STAGES_PX) {
    const camera = cameraOf('Home', width / height);
    expect(farthest(camera, ALL)).toBeGreaterThan(0.94);
    // In wider stages the height of the arm is the limit.
    expect(trayWidth(camera)).toBeGreaterThan(width / height < 1.4 ? 0.45 : 0.4);
  }
  expect(trayWidth(cameraOf('Top', 868 / 648))).toBeGreaterThan(0.9);
});

test('a picture with free space below has everything in it and nothing there', () => {
  const { target_m, toCamera_m } = seatOf('Home', STAGE, {
    tangent: TANGENT,
    aspect: 1.3,
    shift: 0,
    below: 0.1,
  });
  const camera = new PerspectiveCamera(FIELD_DEG, 1.3, 0.01, 20);
  camera.up.set(0, 0, 1);
  camera.position.set(...toCamera_m).add(new Vector3(...target_m));
  camera.lookAt(new Vector3(...target_m));
  camera.updateMatrixWorld();
  expect(farthest(camera, ALL)).toBeLessThan(1);
  const ys = STAGE.tray.map(({ at }) => at.clone().project(camera).y);
  expect(Math.min(...ys)).toBeGreaterThan(-0.8);
});

test('a shifted picture has everything in it, and its middle to the right', () => {
  const camera = cameraOf('Home', 1.6, 0.15);
  expect(farthest(camera, ALL)).toBeLessThan(1);
  const xs = STAGE.tray.map(({ at }) => at.clone().project(camera).x);
  expect((Math.max(...xs) + Math.min(...xs)) / 2).toBeGreaterThan(0.2);
});

test('the home viewpoint is 48° above the front and 13° to the left', () => {
  const { toCamera_m } = seatOf('Home', STAGE, { tangent: TANGENT, aspect: 1.3, shift: 0 });
  const [x, y, z] = toCamera_m;
  expect((Math.atan2(z, Math.hypot(x, y)) * 180) / Math.PI).toBeCloseTo(48, 6);
  expect((Math.atan2(-x, -y) * 180) / Math.PI).toBeCloseTo(13, 6);
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
