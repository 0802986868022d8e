// Rulers along two sides of the workspace, in centimetres.

import { drawText, strokeCased } from '../../plan/marks';
import { gridStepM, multiples } from '../../plan/drawMap';
import type { BasePicture, Draw, MapLayer } from '../../plan/layer';
import { pxFromWorld } from '../../plan/transform';
import { fixed } from '../../ui/format';

const TICK_PX = 7;
const GAP_PX = 14;

const inCm = (place_m: number): string => fixed(100 * place_m, 0);

const drawRulers: Draw<BasePicture> = (ctx, { view, palette, scene }) => {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
  const { isTurned } = view;
  const step = gridStepM(view.pxPerM);
  const within = (from: number, to: number): number[] => [
    ...multiples(step, from + step / 2, to - step / 2),
  ];
  // A zoomed view may not show the sides.
  const edge = ctx.canvas.height / ctx.getTransform().a;
  const left = Math.max(0, pxFromWorld(view, [x_min_m, 0])[0]);
  const bottom = Math.min(edge, pxFromWorld(view, [0, y_min_m])[1]);
  const along = within(x_min_m, x_max_m).map(
    (x_m) => [x_m, pxFromWorld(view, [x_m, 0])[0]] as const,
  );
  const up = within(y_min_m, y_max_m).map((y_m) => [y_m, pxFromWorld(view, [0, y_m])[1]] as const);
  ctx.beginPath();
  for (const [, x] of along) {
    ctx.moveTo(x, bottom);
    ctx.lineTo(x, bottom - TICK_PX);
  }
  for (const [, y] of up) {
    ctx.moveTo(left, y);
    ctx.lineTo(left + TICK_PX, y);
  }
  strokeCased(ctx, palette, { colour: palette['m-ink'], width_px: 1.5 });
  for (const [x_m, x] of along) {
    drawText(ctx, palette, inCm(x_m), [x, bottom - GAP_PX], { align: 'center', isTurned });
  }
  for (const [y_m, y] of up) {
    drawText(ctx, palette, inCm(y_m), [left + GAP_PX, y], { align: 'center', isTurned });
  }
};

export const RULERS_LAYER: MapLayer = {
  id: 'rulers',
  label: 'Rulers, cm',
  swatch: ['m-ink'],
  group: 'Map',
  isSensed: true,
  create: () => ({ aboveWalls: () => drawRulers }),
};
