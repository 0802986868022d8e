// The shape of the tray: a frame around the workspace, the walls in it, and what is free between them.

import type { Polygon, Rect } from '../net/protocol.gen';
import { grown, pxFromWorld, pxRect, type View } from './transform';

/** The longer side of a workspace has so many units, so that all trays look alike. One is a millimetre of a usual one. */
const UNITS = 580;
const MOST_RELIEF_PX = 2.6;
const FRAME = 6;
const CORNER = 11;
/** Points nearer to the border are on it. */
const ON_BORDER_M = 1e-5;

export interface Tray {
  readonly workspace: Rect;
  readonly walls: readonly Polygon[];
}

export function unitM({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): number {
  return Math.max(x_max_m - x_min_m, y_max_m - y_min_m) / UNITS;
}

/** Length of a unit of rim, light and shadow in pixels. In a near view they do not grow with the map. */
export function reliefPx(workspace: Rect, view: View): number {
  return Math.min(MOST_RELIEF_PX, unitM(workspace) * view.pxPerM);
}

/** The workspace with the frame around it. */
export function framed(workspace: Rect): Rect {
  const frame_m = FRAME * unitM(workspace);
  return grown(workspace, { left: frame_m, right: frame_m, top: frame_m, bottom: frame_m });
}

export function cornerPx(workspace: Rect, view: View): number {
  return CORNER * unitM(workspace) * view.pxPerM;
}

/** Clockwise. */
export function trayPath(workspace: Rect, view: View): Path2D {
  const path = new Path2D();
  path.roundRect(...pxRect(view, framed(workspace)), cornerPx(workspace, view));
  return path;
}

function trace(path: Path2D, ring: readonly (readonly [number, number])[], view: View): void {
  ring.forEach((vertex, index) => {
    const [x, y] = pxFromWorld(view, vertex);
    if (index === 0) path.moveTo(x, y);
    else path.lineTo(x, y);
  });
  path.closePath();
}

/** To be filled by the rule `evenodd`. */
export function wallPath(walls: readonly Polygon[], view: View): Path2D {
  const path = new Path2D();
  for (const wall of walls) {
    trace(path, wall.exterior, view);
    for (const hole of wall.holes) trace(path, hole, view);
  }
  return path;
}

/** What no wall covers, to be filled by the rule `evenodd`. */
export function freePath({ workspace, walls }: Tray, view: View): Path2D {
  const path = wallPath(walls, view);
  path.rect(...pxRect(view, workspace));
  return path;
}

/** A side of the workspace: whether a point is on it, and its place along it. */
interface Side {
  readonly has: (x: number, y: number) => boolean;
  readonly along: 0 | 1;
  readonly from: number;
  readonly to: number;
  readonly at: (along: number) => readonly [number, number];
}

function sidesOf({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): Side[] {
  const flat = (y_m: number, isOn: (y: number) => boolean): Side => ({
    has: (_, y) => isOn(y),
    along: 0,
    from: x_min_m,
    to: x_max_m,
    at: (x) => [x, y_m],
  });
  const upright = (x_m: number, isOn: (x: number) => boolean): Side => ({
    has: (x) => isOn(x),
    along: 1,
    from: y_min_m,
    to: y_max_m,
    at: (y) => [x_m, y],
  });
  return [
    flat(y_min_m, (y) => y < y_min_m + ON_BORDER_M),
    flat(y_max_m, (y) => y > y_max_m - ON_BORDER_M),
    upright(x_min_m, (x) => x < x_min_m + ON_BORDER_M),
    upright(x_max_m, (x) => x > x_max_m - ON_BORDER_M),
  ];
}

/** The lines between walls and free places, but not where a wall meets the frame. */
export function edgePath({ workspace, walls }: Tray, view: View): Path2D {
  const path = new Path2D();
  const sides = sidesOf(workspace).map((side) => ({ side, covered: [] as [number, number][] }));
  for (const ring of walls.flatMap(({ exterior, holes }) => [exterior, ...holes])) {
    let isDrawing = false;
    for (let i = 0; i < ring.length; i++) {
      const [a, b] = [ring[i], ring[(i + 1) % ring.length]];
      if (!a || !b) continue;
      const on = sides.find(({ side }) => side.has(...a) && side.has(...b));
      if (on) on.covered.push([a[on.side.along], b[on.side.along]]);
      else {
        if (!isDrawing) path.moveTo(...pxFromWorld(view, a));
        path.lineTo(...pxFromWorld(view, b));
      }
      isDrawing = !on;
    }
  }
  for (const { side, covered } of sides) {
    const walled = covered
      .map(([a, b]): [number, number] => (a < b ? [a, b] : [b, a]))
      .sort(([a], [b]) => a - b);
    let from = side.from;
    for (const [start, end] of [...walled, [side.to, side.to] as const]) {
      if (start > from + ON_BORDER_M) {
        path.moveTo(...pxFromWorld(view, side.at(from)));
        path.lineTo(...pxFromWorld(view, side.at(start)));
      }
      from = Math.max(from, end);
    }
  }
  return path;
}
