// Draws the branches of a comparison: the trail of each bead, and tool and bead at the chosen time.

import { ghostAt } from '../../lab/comparison';
import type { Palette } from '../../ui/palette';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { ComparisonMessage } from '../../net/protocol.gen';
import { pxFromWorld, type View } from '../../plan/transform';
import type { Vec2 } from '../../lab/geometry';

const TOOL_PX = 7;
const BEAD_PX = 3.5;
const FONT = '600 11px system-ui, sans-serif';

type Ctx = CanvasRenderingContext2D;

function ring(ctx: Ctx, [x, y]: Vec2, radius_px: number): void {
  ctx.beginPath();
  ctx.arc(x, y, radius_px, 0, 2 * Math.PI);
}

export function drawGhosts(
  ctx: Ctx,
  view: View,
  palette: Palette,
  comparison: ComparisonMessage,
  tick: number,
): void {
  ctx.save();
  ctx.lineJoin = 'round';
  ctx.font = FONT;
  ctx.textBaseline = 'middle';
  for (const branch of comparison.branches) {
    const ghost = ghostAt(comparison, branch, tick);
    if (!ghost) continue;
    ctx.strokeStyle = palette[branch.controller];
    ctx.fillStyle = palette[branch.controller];
    ctx.lineWidth = 1.75;
    ctx.setLineDash([5, 3]);
    ctx.beginPath();
    for (const [, , x_m, y_m] of branch.samples) ctx.lineTo(...pxFromWorld(view, [x_m, y_m]));
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
    ring(ctx, tool, TOOL_PX);
    ctx.stroke();
    ring(ctx, bead, BEAD_PX);
    ctx.fill();
    // An outline, so that the name is readable on a wall.
    ctx.strokeStyle = palette.floor;
    ctx.lineWidth = 3;
    const label = CONTROLLER_LABELS[branch.controller];
    ctx.strokeText(label, tool[0] + TOOL_PX + 4, tool[1]);
    ctx.fillText(label, tool[0] + TOOL_PX + 4, tool[1]);
  }
  ctx.restore();
}
