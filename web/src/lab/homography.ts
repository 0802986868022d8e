// Converts places of the table to pixels of the camera image; the camera may be tilted. Pure.

import type { BlocksLayer, OverlayMessage, Rect } from '../net/protocol.gen';
import type { Vec2 } from './geometry';

/** Column, row, width and height in pixels. */
export type PixelBlock = BlocksLayer['dark'][number];

export type Homography = OverlayMessage['picture_from_table'];

/** Column and row of a point of the table. */
export function pictureFromTable(homography: Homography, [x_m, y_m]: Vec2): Vec2 {
  const [column, row, factor] = homography.map(([x, y, one]) => x * x_m + y * y_m + one);
  if (column === undefined || row === undefined || !factor) return [NaN, NaN];
  return [column / factor, row / factor];
}

/** The point of the table at a column and row; undefined where the picture shows none. */
export function tableFromPicture(
  homography: Homography,
  [column, row]: Vec2,
): [number, number] | undefined {
  const [[a, b, c], [d, e, f], [g, h, i]] = homography;
  // Two linear equations for x and y.
  const [p, q, r] = [a - column * g, b - column * h, column * i - c];
  const [s, t, u] = [d - row * g, e - row * h, row * i - f];
  const determinant = p * t - q * s;
  const x_m = (r * t - q * u) / determinant;
  const y_m = (p * u - r * s) / determinant;
  const isBefore = g * x_m + h * y_m + i > 0;
  return Number.isFinite(x_m) && Number.isFinite(y_m) && isBefore ? [x_m, y_m] : undefined;
}

/** A rectangle of the table as an SVG path in the image. */
function rectPath(homography: Homography, rect: Rect): string {
  const corners: Vec2[] = [
    [rect.x_min_m, rect.y_max_m],
    [rect.x_max_m, rect.y_max_m],
    [rect.x_max_m, rect.y_min_m],
    [rect.x_min_m, rect.y_min_m],
  ];
  const points = corners.map((corner) =>
    pictureFromTable(homography, corner)
      .map((px) => px.toFixed(1))
      .join(' '),
  );
  return `M${points.join('L')}Z`;
}

export function patchPath(overlay: OverlayMessage): string {
  return rectPath(overlay.picture_from_table, overlay.patch);
}

/** Blocks of the image seen from above, as one SVG path in the camera image. */
export function blocksPath(
  homography: Homography,
  layer: BlocksLayer,
  blocks: readonly PixelBlock[],
): string {
  const [left_m, top_m] = layer.origin_m;
  return blocks
    .map(([column, row, width, height]) =>
      rectPath(homography, {
        x_min_m: left_m + column * layer.pixel_m,
        x_max_m: left_m + (column + width) * layer.pixel_m,
        y_min_m: top_m - (row + height) * layer.pixel_m,
        y_max_m: top_m - row * layer.pixel_m,
      }),
    )
    .join('');
}
