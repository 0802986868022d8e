// The colours of the walls: soft terraces that follow the free places, a lip around these, and grain. They do not depend
// on the view, because they have no sharp lines.

import type { Palette } from '../ui/palette';
import { rgb, type Rgb } from './colourRamp';
import { distancesFrom } from './distances';
import { GRAIN_PX, tissueGrain } from './grain';
import { imageOf } from './pixels';
import { fitView } from './transform';
import { framed, freePath, type Tray, unitM } from './tray';

/** Distances from the free places, in units, and how much the tissue that is nearer is darker. */
const TERRACES = [
  [118, 0.11],
  [84, 0.13],
  [56, 0.16],
  [32, 0.2],
] as const;
/** Width of the step between two terraces, and of the light on it. */
const STEP = 1.8;
const LIGHT_ALPHA = 0.07;
const LIP = 9.5;
const LIP_SOFT = 9;
const GRAIN: Rgb = [64, 20, 13];
const GRAIN_ALPHA = 0.05;

const clamp = (share: number): number => Math.min(1, Math.max(0, share));

/** A picture of the tray with its frame: one pixel per unit. */
export function tissueImage(tray: Tray, palette: Palette): HTMLCanvasElement | undefined {
  const rect = framed(tray.workspace);
  const unit = unitM(tray.workspace);
  const columns = Math.ceil((rect.x_max_m - rect.x_min_m) / unit);
  const rows = Math.ceil((rect.y_max_m - rect.y_min_m) / unit);
  const canvas = document.createElement('canvas');
  canvas.width = columns;
  canvas.height = rows;
  const ctx = canvas.getContext('2d', { willReadFrequently: true });
  if (!ctx) return undefined;
  ctx.fill(freePath(tray, fitView(rect, columns, rows)), 'evenodd');
  const { data } = ctx.getImageData(0, 0, columns, rows);
  const distances = distancesFrom((pixel) => (data[4 * pixel + 3] ?? 0) > 127, columns, rows);
  const [wall, deep, lip] = [
    rgb(palette.wall),
    rgb(palette['wall-deep']),
    rgb(palette['wall-lip']),
  ];
  const grain = tissueGrain();
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  distances.forEach((distance, i) => {
    let left = 1;
    let light = 0;
    for (const [far, dark] of TERRACES) {
      const beyond = (distance - far) / STEP;
      left *= 1 - dark * clamp(0.5 - beyond);
      light = Math.max(light, 1 - Math.abs(beyond - 0.6));
    }
    const inLip = clamp((LIP - distance) / LIP_SOFT + 0.5);
    const [x, y] = [i % columns, Math.floor(i / columns)];
    const speck = grain[(y % GRAIN_PX) * GRAIN_PX + (x % GRAIN_PX)] ?? 0;
    const grainShare = GRAIN_ALPHA * clamp(1.8 * speck - 0.5);
    for (const k of [0, 1, 2] as const) {
      let value = deep[k] + left * (wall[k] - deep[k]);
      value += Math.max(0, light) * LIGHT_ALPHA * (255 - value);
      value += inLip * (lip[k] - value);
      pixels[4 * i + k] = value + grainShare * (GRAIN[k] - value);
    }
    pixels[4 * i + 3] = 255;
  });
  return imageOf(pixels, columns);
}
