// Converts between the table and a perspective view of it. Pure except for three's matrices.

import { Matrix3, Vector3, type Matrix4 } from 'three';
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
  clipFromBase: Matrix4,
  widthPx: number,
  heightPx: number,
): TableView {
  const fromTable = pxFromTable(clipFromBase, widthPx, heightPx);
  const toTable = fromTable.clone().invert();
  const e = [...clipFromBase.elements];
  const at = (i: number): number => e[i] ?? 0;
  // The share of the height, in the order of the rows of `fromTable`.
  const perHeight: readonly [number, number, number] = [
    (widthPx / 2) * (at(8) + at(11)),
    (heightPx / 2) * (at(11) - at(9)),
    at(11),
  ];
  const place = new Vector3();

  return {
    toPx: ([x_m, y_m]: Vec2, height_m = 0) => {
      place.set(x_m, y_m, 1).applyMatrix3(fromTable);
      const depth = place.z + height_m * perHeight[2];
      if (depth <= 0) return undefined;
      const across = place.x + height_m * perHeight[0];
      const down = place.y + height_m * perHeight[1];
      return [across / depth, down / depth];
    },
    toWorld: ([x_px, y_px]: Vec2) => {
      const found = new Vector3(x_px, y_px, 1).applyMatrix3(toTable);
      if (found.z === 0) return undefined;
      const [x_m, y_m] = [found.x / found.z, found.y / found.z];
      // A ray above the horizon meets the table behind the camera.
      const isAhead = place.set(x_m, y_m, 1).applyMatrix3(fromTable).z > 0;
      return isAhead ? [x_m, y_m] : undefined;
    },
  };
}
