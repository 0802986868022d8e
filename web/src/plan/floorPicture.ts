// The picture of the base map on the floor of the 3-D scene.

import type { Rect } from '../net/protocol.gen';
import { fitView, type View } from './transform';
import { type BaseMap, paintAbove, paintGround } from './baseMap';

/** The longer side of the workspace, in pixels of the base map. */
const LONGER_PX = 460;
/** Pixels of the picture per pixel of the base map. */
const RATIO = 2;
const INSETS = { left: 0, right: 0, top: 0, bottom: 0 };

/** A picture of the base map in pixels of `view`, each `ratio` of the canvas. */
export interface FloorPicture {
  readonly canvas: HTMLCanvasElement;
  readonly view: View;
  readonly ratio: number;
  readonly workspace: Rect;
}

const widthOf = ({ x_min_m, x_max_m }: Rect): number => x_max_m - x_min_m;
const heightOf = ({ y_min_m, y_max_m }: Rect): number => y_max_m - y_min_m;

/** The picture of the workspace alone, because it is drawn often. */
export function createFloorPicture(workspace: Rect): FloorPicture {
  const perM = LONGER_PX / Math.max(widthOf(workspace), heightOf(workspace));
  const width_px = Math.ceil(widthOf(workspace) * perM);
  const height_px = Math.ceil(heightOf(workspace) * perM);
  const canvas = document.createElement('canvas');
  canvas.width = RATIO * width_px;
  canvas.height = RATIO * height_px;
  return { canvas, view: fitView(workspace, width_px, height_px, INSETS), ratio: RATIO, workspace };
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
