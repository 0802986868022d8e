// Fog over what the camera has not seen.

import type { SeenMessage } from '../net/protocol.gen';
import { seenCells, UNKNOWN } from '../lab/obstacleMap';
import { rgb } from './colourRamp';
import type { BasePicture, Draw } from './layer';
import { gridPixels, imageOf, type Rgba } from './pixels';
import { pxRect } from './transform';
import type { Palette } from '../ui/palette';

const CLEAR: Rgba = [0, 0, 0, 0];

/** One pixel per cell; everything is in fog before the first obstacle map. */
export function fogPixels(
  seen: Pick<SeenMessage, 'columns' | 'rows' | 'runs'> = { columns: 1, rows: 1, runs: [] },
  palette: Palette,
): Uint8ClampedArray<ArrayBuffer> {
  const cells = seenCells(seen);
  const fog: Rgba = [...rgb(palette.fog), 255];
  return gridPixels(seen.columns, seen.rows, (cell) => (cells[cell] === UNKNOWN ? fog : CLEAR));
}

export function fogImage(seen: SeenMessage | undefined, palette: Palette): HTMLCanvasElement {
  return imageOf(fogPixels(seen, palette), seen?.columns ?? 1);
}

export const drawFog =
  (fog: HTMLCanvasElement): Draw<BasePicture> =>
  (ctx, { view, scene }) => {
    // No smoothing: cells have sharp edges.
    ctx.imageSmoothingEnabled = false;
    ctx.drawImage(fog, ...pxRect(view, scene.workspace));
  };
