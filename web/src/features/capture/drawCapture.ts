// Draws where the magnet captures the bead.

import type { Vec2 } from '../../lab/geometry';
import { strokeCased } from '../../plan/marks';
import type { MovingPicture } from '../../plan/layer';
import { pxFromWorld } from '../../plan/transform';
import { sectorsOf } from './sectors';
import type { Ctx } from '../../plan/sheet';

export function drawCapture(ctx: Ctx, { view, palette, scene, free, state }: MovingPicture): void {
  const [toolX_m, toolY_m] = state.tool_m;
  const px = ([x_m, y_m]: Vec2): Vec2 => pxFromWorld(view, [toolX_m + x_m, toolY_m + y_m]);
  const [fill, edge] = [new Path2D(), new Path2D()];
  for (const { inner, outer } of sectorsOf(scene)) {
    fill.moveTo(...px(inner[0]));
    for (const corner of [outer[0], outer[1], inner[1]]) fill.lineTo(...px(corner));
    fill.closePath();
    for (const [from, to] of [inner, outer]) {
      edge.moveTo(...px(from));
      edge.lineTo(...px(to));
    }
  }
  ctx.save();
  ctx.clip(free, 'evenodd');
  ctx.fillStyle = palette['field-high'];
  ctx.globalAlpha = 0.16;
  ctx.fill(fill);
  ctx.restore();
  strokeCased(ctx, palette, { colour: palette.magnet, width_px: 1.5 }, edge);
}
