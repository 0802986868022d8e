// The pictures on the floor of the 3-D scene: the base map, and around it the numbers of the axes, large enough to read
// from a distance.

import type { Rect } from '../net/protocol.gen';
import { fitView, type Insets, type View } from './transform';
import { drawNumbers } from './drawMap';
import { type BaseMap, paintAbove, paintGround } from './baseMap';
import type { Palette } from '../ui/palette';

/** The longer side of the workspace, in pixels of the base map. */
const LONGER_PX = 460;
/** Pixels of the picture per pixel of the base map. */
const RATIO = 2;
/** Space for the numbers of the axes, in pixels. */
const INSETS = { left: 40, right: 12, top: 12, bottom: 26 };

/** A picture of the base map in pixels of `view`, each `ratio` of the canvas. */
export interface FloorPicture {
  readonly canvas: HTMLCanvasElement;
  readonly view: View;
  readonly ratio: number;
  readonly workspace: Rect;
}

const widthOf = ({ x_min_m, x_max_m }: Rect): number => x_max_m - x_min_m;
const heightOf = ({ y_min_m, y_max_m }: Rect): number => y_max_m - y_min_m;
const pxPerM = (workspace: Rect): number =>
  LONGER_PX / Math.max(widthOf(workspace), heightOf(workspace));

/** Width of the numbers' area outside the workspace, in metres. */
export function floorMargins(workspace: Rect): Insets {
  const perM = pxPerM(workspace);
  const { left, right, top, bottom } = INSETS;
  return { left: left / perM, right: right / perM, top: top / perM, bottom: bottom / perM };
}

function createPicture(workspace: Rect, insets: Insets): FloorPicture {
  const perM = pxPerM(workspace);
  const width_px = Math.ceil(widthOf(workspace) * perM) + insets.left + insets.right;
  const height_px = Math.ceil(heightOf(workspace) * perM) + insets.top + insets.bottom;
  const canvas = document.createElement('canvas');
  canvas.width = RATIO * width_px;
  canvas.height = RATIO * height_px;
  return { canvas, view: fitView(workspace, width_px, height_px, insets), ratio: RATIO, workspace };
}

/** The picture of the workspace alone, because it is drawn often. */
export function createFloorPicture(workspace: Rect): FloorPicture {
  return createPicture(workspace, { left: 0, right: 0, top: 0, bottom: 0 });
}

/** The picture of the numbers around the workspace, which is static. */
export function numbersPicture(workspace: Rect, palette: Palette): FloorPicture {
  const picture = createPicture(workspace, INSETS);
  const ctx = picture.canvas.getContext('2d');
  ctx?.scale(RATIO, RATIO);
  if (ctx) drawNumbers(ctx, workspace, picture.view, palette);
  return picture;
}

/** Draws the base map on it again. */
export function repaintFloor({ canvas, ratio }: FloorPicture, map: BaseMap): void {
  // Without transparency the picture needs no conversion for the graphics card.
  const ctx = canvas.getContext('2d', { alpha: false });
  if (!ctx) return;
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  paintGround(ctx, map.ground);
  paintAbove(ctx, map);
}
