// Draws the locus: trails of tool and bead, the goal, the walls, the disturbances.

import { pxFromWorld, type View } from '../../plan/transform';
import type { Sample } from './sample';
import { distance, type Vec2 } from '../../lab/geometry';
import { drawGoal } from '../../plan/drawMoving';
import { circle } from '../../plan/shapes';
import { drawTrail } from '../../plan/drawTrail';
import type { Ctx } from '../../plan/sheet';
import type { Palette } from '../../ui/palette';

const DOT_PX = 3;
const STRUCK_PX = 3.5;
const WALL_ALPHA = 0.45;

export interface LocusPicture {
  readonly view: View;
  readonly palette: Palette;
  readonly walls: Path2D;
  readonly sample: Sample;
  readonly goal_m: Vec2 | undefined;
  /** The marked sample: the one under the pointer, otherwise the present one. */
  readonly marked: number | undefined;
}

function dot(ctx: Ctx, color: string, edge: string, at: Vec2): void {
  circle(ctx, at, DOT_PX);
  ctx.fillStyle = color;
  ctx.fill();
  ctx.strokeStyle = edge;
  ctx.lineWidth = 1;
  ctx.stroke();
}

export function placesAt(sample: Sample, index: number): { tool: Vec2; bead: Vec2 } {
  const { tool_x_m, tool_y_m, bead_x_m, bead_y_m } = sample.columns;
  return {
    tool: [tool_x_m[index] ?? 0, tool_y_m[index] ?? 0],
    bead: [bead_x_m[index] ?? 0, bead_y_m[index] ?? 0],
  };
}

export function drawLocus(ctx: Ctx, picture: LocusPicture): void {
  const { view, palette, sample } = picture;
  const { columns } = sample;
  ctx.globalAlpha = WALL_ALPHA;
  ctx.fillStyle = palette.wall;
  ctx.fill(picture.walls, 'evenodd');
  ctx.globalAlpha = 1;
  drawTrail(ctx, view, palette.magnet, columns.tool_x_m, columns.tool_y_m);
  drawTrail(ctx, view, palette.bead, columns.bead_x_m, columns.bead_y_m);
  if (picture.goal_m) drawGoal(ctx, view, palette, picture.goal_m);
  ctx.strokeStyle = palette.you;
  ctx.lineWidth = 1.75;
  ctx.beginPath();
  for (const { at_m } of sample.struck) {
    const [x, y] = pxFromWorld(view, at_m);
    ctx.moveTo(x - STRUCK_PX, y - STRUCK_PX);
    ctx.lineTo(x + STRUCK_PX, y + STRUCK_PX);
    ctx.moveTo(x + STRUCK_PX, y - STRUCK_PX);
    ctx.lineTo(x - STRUCK_PX, y + STRUCK_PX);
  }
  ctx.stroke();
  if (picture.marked === undefined) return;
  const { tool, bead } = placesAt(sample, picture.marked);
  dot(ctx, palette.magnet, palette.floor, pxFromWorld(view, tool));
  dot(ctx, palette.bead, palette.floor, pxFromWorld(view, bead));
}

/** Index of the sample whose tool or bead is nearest to a place, within `reachPx`. The later one wins a tie. */
export function sampleAt(
  sample: Sample,
  view: View,
  at: Vec2,
  reachPx: number,
): number | undefined {
  let best: number | undefined;
  let bestPx = reachPx;
  for (let index = 0; index < sample.columns.tick.length; index++) {
    const { tool, bead } = placesAt(sample, index);
    const px = Math.min(
      distance(at, pxFromWorld(view, tool)),
      distance(at, pxFromWorld(view, bead)),
    );
    if (px > bestPx) continue;
    best = index;
    bestPx = px;
  }
  return best;
}
