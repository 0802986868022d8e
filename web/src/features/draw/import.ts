// A map's drawing as shapes that can be edited: the server reads it, and sends its walls as outlines.

import type { MapCheck, Polygon, Rect } from '../../net/protocol.gen';
import type { Area, Drawing, Frame, Mm } from './drawing';

const MM_PER_M = 1000;

/** A hundredth of a millimetre, as in the drawing's text. */
const rounded = (m: number): number => Number((MM_PER_M * m).toFixed(2));

const place = ([x_m = 0, y_m = 0]: readonly number[]): Mm => [rounded(x_m), 0 - rounded(y_m)];

export function frameOf({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): Frame {
  return {
    x_mm: rounded(x_min_m),
    y_mm: 0 - rounded(y_max_m),
    width_mm: rounded(x_max_m - x_min_m),
    height_mm: rounded(y_max_m - y_min_m),
  };
}

function areaOf({ exterior, holes }: Polygon): Area {
  return { kind: 'area', rings: [exterior, ...holes].map((ring) => ring.map(place)) };
}

type Found = Pick<MapCheck, 'workspace' | 'positioner' | 'outlines'>;

export function drawingOf({ workspace, positioner, outlines }: Found): Drawing {
  return { frame: frameOf(workspace), positioner, shapes: outlines.map(areaOf) };
}
