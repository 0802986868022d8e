// Zoom and pan of the plan view. Pure.

import { clampToRect, type Vec2 } from '../lab/geometry';
import type { Rect } from '../net/protocol.gen';
import { type View, worldFromPx } from './transform';

const MOST = 12;

export interface Zoom {
  /** 1 shows the whole workspace. */
  readonly factor: number;
  /** The point of the table in the middle of the canvas; ignored at factor 1. */
  readonly middle_m: Vec2;
}

export const WHOLE: Zoom = { factor: 1, middle_m: [0, 0] };

/** A canvas and its view of the whole workspace. */
export interface Frame {
  readonly width: number;
  readonly height: number;
  readonly fit: View;
  readonly workspace: Rect;
}

export function zoomedView({ width, height, fit }: Frame, { factor, middle_m }: Zoom): View {
  if (factor === 1) return fit;
  const pxPerM = fit.pxPerM * factor;
  return {
    pxPerM,
    originX: width / 2 - middle_m[0] * pxPerM,
    originY: height / 2 + middle_m[1] * pxPerM,
  };
}

/** The zoom with another factor, with the same place of the table at a pixel. */
export function zoomAt(frame: Frame, zoom: Zoom, px: Vec2, by: number): Zoom {
  const factor = Math.min(MOST, Math.max(1, zoom.factor * by));
  if (factor === 1) return WHOLE;
  const at = worldFromPx(zoomedView(frame, zoom), px);
  const pxPerM = frame.fit.pxPerM * factor;
  const middle: Vec2 = [
    at[0] - (px[0] - frame.width / 2) / pxPerM,
    at[1] + (px[1] - frame.height / 2) / pxPerM,
  ];
  return { factor, middle_m: clampToRect(frame.workspace, middle) };
}

/** The zoom after the picture was moved by some pixels. */
export function panBy(frame: Frame, zoom: Zoom, by: Vec2): Zoom {
  if (zoom.factor === 1) return zoom;
  const pxPerM = frame.fit.pxPerM * zoom.factor;
  const middle: Vec2 = [zoom.middle_m[0] - by[0] / pxPerM, zoom.middle_m[1] + by[1] / pxPerM];
  return { factor: zoom.factor, middle_m: clampToRect(frame.workspace, middle) };
}
