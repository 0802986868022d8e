import { Matrix4, PerspectiveCamera, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { perspectiveView, pxFromTable } from './perspective';

const [WIDTH, HEIGHT] = [800, 400];

function cameraAt(position: Vector3, target: Vector3): PerspectiveCamera {
  const camera = new PerspectiveCamera(40, WIDTH / HEIGHT, 0.01, 10);
  camera.up.set(0, 0, 1);
  camera.position.copy(position);
  camera.lookAt(target);
  camera.updateMatrixWorld();
  return camera;
}

const clipFromBase = (camera: PerspectiveCamera): Matrix4 =>
  new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);

const camera = cameraAt(new Vector3(0.4, -1.4, 0.8), new Vector3(0, -0.4, 0));
const view = perspectiveView(camera, WIDTH, HEIGHT);

test('the target of the camera is in the middle', () => {
  const [x, y] = view.toPx([0, -0.4]) ?? [];
  expect(x).toBeCloseTo(WIDTH / 2);
  expect(y).toBeCloseTo(HEIGHT / 2);
});

test('points on the table and above it have the pixels that three calculates', () => {
  for (const [x, y, z] of [
    [0.2, -0.3, 0],
    [-0.25, -0.5, 0.0025],
    [0.1, -0.4, 0.2],
  ] as const) {
    const clip = new Vector3(x, y, z).project(camera);
    const px = view.toPx([x, y], z);
    expect(px?.[0]).toBeCloseTo(((clip.x + 1) * WIDTH) / 2, 6);
    expect(px?.[1]).toBeCloseTo(((1 - clip.y) * HEIGHT) / 2, 6);
  }
});

test('a pixel is mapped back to its point of the table', () => {
  const px = view.toPx([0.13, -0.47]);
  const [x, y] = (px && view.toWorld(px)) ?? [];
  expect(x).toBeCloseTo(0.13, 9);
  expect(y).toBeCloseTo(-0.47, 9);
});

test('a pixel above the horizon has no point, a point behind the camera has no pixel', () => {
  const low = cameraAt(new Vector3(0, -1, 0.1), new Vector3(0, 0, 0.1));
  const horizontal = perspectiveView(low, WIDTH, HEIGHT);
  expect(horizontal.toWorld([WIDTH / 2, HEIGHT / 2 - 20])).toBeUndefined();
  expect(horizontal.toWorld([WIDTH / 2, HEIGHT / 2 + 20])).toBeDefined();
  expect(horizontal.toPx([0, -2])).toBeUndefined();
});

test('a view does not follow later changes of the camera', () => {
  const moving = cameraAt(new Vector3(0, -1, 1), new Vector3(0, 0, 0));
  const before = perspectiveView(moving, WIDTH, HEIGHT);
  const px = before.toPx([0.1, 0.1], 0.05);
  moving.rotateX(1);
  moving.updateMatrixWorld();
  expect(before.toPx([0.1, 0.1], 0.05)).toEqual(px);
});

test('the matrix for browser tests maps a point to the same pixel as the view', () => {
  const at = new Vector3(0.2, -0.3, 1).applyMatrix3(
    pxFromTable(clipFromBase(camera), WIDTH, HEIGHT),
  );
  const px = view.toPx([0.2, -0.3]) ?? [NaN, NaN];
  expect(at.x / at.z).toBeCloseTo(px[0], 9);
  expect(at.y / at.z).toBeCloseTo(px[1], 9);
});
