// Draws a run beside the session's own: the way of its bead, and tool and bead at one time.

import type { Vec2 } from '../lab/geometry';
import { circle } from './shapes';
import { pxFromWorld, type View } from './transform';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

const TOOL_PX = 7;
const BEAD_PX = 3.5;
const FONT = '600 11px system-ui, sans-serif';

export interface DrawnGhost {
  readonly colour: string;
  readonly label: string;
  /** Places of the bead. */
  readonly path_m: readonly Vec2[];
  readonly tool_m: Vec2;
  readonly bead_m: Vec2;
}

/** Text with an outline, so that it is readable on a wall. */
export function drawLabel(ctx: Ctx, palette: Palette, text: string, [x, y]: Vec2): void {
  ctx.font = FONT;
  ctx.textBaseline = 'middle';
  ctx.lineJoin = 'round';
  ctx.strokeStyle = palette.floor;
  ctx.lineWidth = 3;
  ctx.strokeText(text, x, y);
  ctx.fillText(text, x, y);
}

export function drawGhost(ctx: Ctx, view: View, palette: Palette, ghost: DrawnGhost): void {
  ctx.save();
  ctx.lineJoin = 'round';
  ctx.strokeStyle = ghost.colour;
  ctx.fillStyle = ghost.colour;
  ctx.lineWidth = 1.75;
  ctx.setLineDash([5, 3]);
  ctx.beginPath();
  for (const place of ghost.path_m) ctx.lineTo(...pxFromWorld(view, place));
  ctx.stroke();
  ctx.setLineDash([]);
  const tool = pxFromWorld(view, ghost.tool_m);
  const bead = pxFromWorld(view, ghost.bead_m);
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(...tool);
  ctx.lineTo(...bead);
  ctx.stroke();
  ctx.lineWidth = 2;
  circle(ctx, tool, TOOL_PX);
  ctx.stroke();
  circle(ctx, bead, BEAD_PX);
  ctx.fill();
  drawLabel(ctx, palette, ghost.label, [tool[0] + TOOL_PX + 4, tool[1]]);
  ctx.restore();
}
