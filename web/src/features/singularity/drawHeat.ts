// Draws the singularity layer: smooth colours, and hatching where the arm may not go.

import type { WorkspaceMap } from '../../net/protocol.gen';
import type { BasePicture } from '../../plan/layer';
import { imageOf } from '../../plan/pixels';
import { pxFromWorld } from '../../plan/transform';
import { rampOf } from '../../plan/colourRamp';
import { heatPixels, refusedRuns, type Run } from './heat';
import type { Ctx } from '../../plan/sheet';
import type { Palette } from '../../ui/palette';

const HATCH_PX = 7;

export interface Heat {
  readonly map: WorkspaceMap;
  /** One pixel per cell. */
  readonly image: HTMLCanvasElement;
  readonly refused: readonly Run[];
}

export function createHeat(map: WorkspaceMap, palette: Palette): Heat {
  const image = imageOf(heatPixels(map, rampOf(palette, 'heat')), map.columns);
  return { map, image, refused: refusedRuns(map) };
}

/** Slanted lines over the box; the clip cuts them to shape. */
function hatch(ctx: Ctx, left: number, top: number, width: number, height: number): void {
  ctx.beginPath();
  for (let x = left - height; x < left + width; x += HATCH_PX) {
    ctx.moveTo(x, top + height);
    ctx.lineTo(x + height, top);
  }
  ctx.stroke();
}

export function drawHeat(ctx: Ctx, { view, palette }: BasePicture, heat: Heat): void {
  const { columns, rows, origin_m, cell_m } = heat.map;
  const side = cell_m * view.pxPerM;
  const [left, bottom] = pxFromWorld(view, origin_m);
  const top = bottom - rows * side;
  ctx.drawImage(heat.image, left, top, columns * side, rows * side);
  if (heat.refused.length === 0) return;
  const cells = new Path2D();
  for (const [row, column, count] of heat.refused) {
    cells.rect(left + column * side, bottom - (row + 1) * side, count * side, side);
  }
  ctx.save();
  ctx.clip(cells);
  ctx.fillStyle = palette['singular-low'];
  ctx.fillRect(left, top, columns * side, rows * side);
  ctx.strokeStyle = palette.case;
  ctx.lineWidth = 1.25;
  hatch(ctx, left, top, columns * side, rows * side);
  ctx.restore();
}
