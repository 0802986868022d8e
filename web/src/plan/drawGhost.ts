// Draws a run beside the session's own: the way of its bead, and tool and bead at one time.

import type { Vec2 } from '../lab/geometry';
import type { Controller } from '../ui/controllers';
import { drawHead, Labels, lineOf, strokeCased } from './marks';
import { circle } from './shapes';
import { pxFromWorld, type View } from './transform';
import { GOAL_RADIUS_M } from '../net/protocol.gen';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

const TOOL_PX = 6;
const HEAD_PX = 9;
const LINE_PX = 3;
const AHEAD_ALPHA = 0.5;

export interface DrawnGhost {
  readonly controller: Controller;
  readonly label: string;
  /** Places of the bead until now. */
  readonly path_m: readonly Vec2[];
  /** Its places from then on. */
  readonly ahead_m?: readonly Vec2[];
  readonly tool_m: Vec2;
  readonly bead_m: Vec2;
}

function trace(ctx: Ctx, view: View, places: readonly Vec2[]): void {
  ctx.beginPath();
  for (const place of places) ctx.lineTo(...pxFromWorld(view, place));
}

/** Labels that leave the goal free. */
export function labelsBeside(view: View, goal_m: Vec2 | undefined): Labels {
  const labels = new Labels(view.isTurned);
  if (goal_m) labels.keep(pxFromWorld(view, goal_m), GOAL_RADIUS_M * view.pxPerM);
  return labels;
}

/** The labels come last, over the lines of all. */
export function drawGhosts(
  ctx: Ctx,
  view: View,
  palette: Palette,
  ghosts: readonly DrawnGhost[],
  labels: Labels,
): void {
  for (const { controller, path_m, ahead_m, tool_m, bead_m } of ghosts) {
    const line = lineOf(palette, controller, LINE_PX);
    if (ahead_m) {
      ctx.save();
      ctx.globalAlpha = AHEAD_ALPHA;
      trace(ctx, view, ahead_m);
      ctx.strokeStyle = line.colour;
      ctx.lineWidth = 1.5;
      ctx.stroke();
      ctx.restore();
    }
    trace(ctx, view, path_m);
    strokeCased(ctx, palette, line);
    const [tool, bead] = [pxFromWorld(view, tool_m), pxFromWorld(view, bead_m)];
    ctx.beginPath();
    ctx.moveTo(...tool);
    ctx.lineTo(...bead);
    strokeCased(ctx, palette, { colour: line.colour, width_px: 1 });
    circle(ctx, tool, TOOL_PX);
    strokeCased(ctx, palette, { colour: line.colour, width_px: 1.5 });
  }
  for (const { controller, bead_m, tool_m } of ghosts) {
    const bead = pxFromWorld(view, bead_m);
    drawHead(ctx, palette, controller, bead);
    labels.keep(bead, HEAD_PX);
    labels.keep(pxFromWorld(view, tool_m), TOOL_PX);
  }
  for (const { label, bead_m } of ghosts) {
    labels.draw(ctx, palette, label, pxFromWorld(view, bead_m), HEAD_PX + 5);
  }
}
