// Converts between metres on the table (x right, y up) and CSS pixels on a canvas (x right, y down).

import type { TableView, Vec2 } from '../lab/geometry';
import type { Rect } from '../net/protocol.gen';

export interface View {
  /** CSS pixels per metre, the same in x and y. */
  readonly pxPerM: number;
  /** Canvas position of the world's origin, in CSS pixels; it may lie outside the canvas. */
  readonly originX: number;
  readonly originY: number;
  /** The page shows the canvas turned by 90°, clockwise. */
  readonly isTurned?: true;
}

export interface Insets {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** The rectangle with more space at its sides. */
export function grown(rect: Rect, { left, right, top, bottom }: Insets): Rect {
  return {
    x_min_m: rect.x_min_m - left,
    x_max_m: rect.x_max_m + right,
    y_min_m: rect.y_min_m - bottom,
    y_max_m: rect.y_max_m + top,
  };
}

const NO_INSETS: Insets = { left: 0, right: 0, top: 0, bottom: 0 };

/** Shows all of `world`, centred, as large as possible inside `insets`. */
export function fitView(
  world: Rect,
  widthPx: number,
  heightPx: number,
  insets: Insets = NO_INSETS,
): View {
  const worldWidth = world.x_max_m - world.x_min_m;
  const worldHeight = world.y_max_m - world.y_min_m;
  const roomX = Math.max(1, widthPx - insets.left - insets.right);
  const roomY = Math.max(1, heightPx - insets.top - insets.bottom);
  const pxPerM = Math.min(roomX / worldWidth, roomY / worldHeight);
  const left = insets.left + (roomX - worldWidth * pxPerM) / 2;
  const top = insets.top + (roomY - worldHeight * pxPerM) / 2;
  return {
    pxPerM,
    originX: left - world.x_min_m * pxPerM,
    originY: top + world.y_max_m * pxPerM,
  };
}

export function pxFromWorld(view: View, point: Vec2): [number, number] {
  return [view.originX + point[0] * view.pxPerM, view.originY - point[1] * view.pxPerM];
}

/** Left, top, width and height of a rectangle of the table. */
export function pxRect(view: View, rect: Rect): [number, number, number, number] {
  const [left, top] = pxFromWorld(view, [rect.x_min_m, rect.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [rect.x_max_m, rect.y_min_m]);
  return [left, top, right - left, bottom - top];
}

export function worldFromPx(view: View, point: Vec2): [number, number] {
  return [(point[0] - view.originX) / view.pxPerM, (view.originY - point[1]) / view.pxPerM];
}

export function tableViewOf(view: View): TableView {
  return {
    toWorld: (px) => worldFromPx(view, px),
    toPx: (point) => pxFromWorld(view, point),
  };
}
