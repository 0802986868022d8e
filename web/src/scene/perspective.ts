// Converts between the table and a perspective view of it. Pure except for three's matrices.

import { Matrix3, Vector3, type Matrix4, type PerspectiveCamera } from 'three';
import type { TableView, Vec2 } from '../lab/geometry';

/** Homogeneous matrix from table to pixels, row by row. */
export function pxFromTable(clipFromBase: Matrix4, widthPx: number, heightPx: number): Matrix3 {
  const e = clipFromBase.elements;
  const row = (i: number, column: number): number => e[4 * column + i] ?? 0;
  const across = (column: number): number => (widthPx / 2) * (row(0, column) + row(3, column));
  const down = (column: number): number => (heightPx / 2) * (row(3, column) - row(1, column));
  // prettier-ignore
  return new Matrix3(
    across(0), across(1), across(3),
    down(0), down(1), down(3),
    row(3, 0), row(3, 1), row(3, 3),
  );
}

/** The mapping of the present camera. It does not follow later changes. */
export function perspectiveView(
  camera: PerspectiveCamera,
  widthPx: number,
  heightPx: number,
): TableView {
  const now = camera.clone();
  return {
    toPx: ([x_m, y_m], height_m = 0) => {
      const at = new Vector3(x_m, y_m, height_m).applyMatrix4(now.matrixWorldInverse);
      if (at.z >= 0) return undefined;
      const { x, y } = at.applyMatrix4(now.projectionMatrix);
      return [((1 + x) * widthPx) / 2, ((1 - y) * heightPx) / 2];
    },
    toWorld: (px) => {
      const ray = rayAt(now, px, widthPx, heightPx);
      // Above the horizon it does not meet the table.
      if (ray.z >= 0) return undefined;
      const { x, y } = ray.multiplyScalar(-now.position.z / ray.z).add(now.position);
      return [x, y];
    },
  };
}

/** Direction from the camera to what is seen at a pixel. */
export function rayAt(
  camera: PerspectiveCamera,
  [x_px, y_px]: Vec2,
  widthPx: number,
  heightPx: number,
): Vector3 {
  return new Vector3((2 * x_px) / widthPx - 1, 1 - (2 * y_px) / heightPx, 1)
    .unproject(camera)
    .sub(camera.position)
    .normalize();
}
