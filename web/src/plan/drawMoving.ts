// Draws the moving parts of the workspace, from back to front.

import { GOAL_RADIUS_M } from '../net/protocol.gen';
import { pxFromWorld, type View } from './transform';
import type { Vec2 } from '../lab/geometry';
import { circle, cross } from './shapes';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

/** The bead has a diameter of 5 mm. On a small canvas it is enlarged to stay visible. */
const MIN_BEAD_PX = 4.5;
const TRACKED_PX = 4;
const TOOL_PX = 8;

export function beadRadiusPx(view: View, radius_m: number): number {
  return Math.max(MIN_BEAD_PX, radius_m * view.pxPerM);
}

export function drawGoal(ctx: Ctx, view: View, palette: Palette, goal: Vec2): void {
  const at = pxFromWorld(view, goal);
  circle(ctx, at, GOAL_RADIUS_M * view.pxPerM);
  ctx.fillStyle = palette.goal;
  ctx.globalAlpha = 0.16;
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.strokeStyle = palette.goal;
  ctx.lineWidth = 2;
  ctx.stroke();
  cross(ctx, at, 6);
  ctx.stroke();
}

export function drawBead(
  ctx: Ctx,
  view: View,
  palette: Palette,
  bead: Vec2,
  radius_m: number,
  canGrabRadiusPx: number | undefined,
): void {
  const at = pxFromWorld(view, bead);
  if (canGrabRadiusPx !== undefined) {
    circle(ctx, at, canGrabRadiusPx);
    ctx.fillStyle = palette.bead;
    ctx.globalAlpha = 0.18;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.strokeStyle = palette.bead;
    ctx.lineWidth = 1.5;
    ctx.stroke();
  }
  circle(ctx, at, beadRadiusPx(view, radius_m));
  ctx.fillStyle = palette.bead;
  ctx.fill();
  ctx.strokeStyle = palette.floor;
  ctx.lineWidth = 1.25;
  ctx.stroke();
}

export function drawTracked(ctx: Ctx, view: View, palette: Palette, tracked: Vec2): void {
  ctx.strokeStyle = palette.ink;
  ctx.lineWidth = 1;
  cross(ctx, pxFromWorld(view, tracked), TRACKED_PX);
  ctx.stroke();
}

/** A dashed line from the tool to where the hand points it. */
export function drawSteering(ctx: Ctx, view: View, palette: Palette, tool: Vec2, to: Vec2): void {
  const [from, at] = [pxFromWorld(view, tool), pxFromWorld(view, to)];
  ctx.save();
  ctx.strokeStyle = palette.you;
  ctx.lineWidth = 1.5;
  ctx.setLineDash([5, 4]);
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...at);
  ctx.stroke();
  ctx.setLineDash([]);
  ctx.lineWidth = 2;
  circle(ctx, at, 6);
  ctx.stroke();
  ctx.restore();
}

export function drawTool(ctx: Ctx, view: View, palette: Palette, tool: Vec2): void {
  const at = pxFromWorld(view, tool);
  ctx.strokeStyle = palette.floor;
  ctx.lineWidth = 4;
  circle(ctx, at, TOOL_PX);
  ctx.stroke();
  ctx.strokeStyle = palette.magnet;
  ctx.lineWidth = 2;
  ctx.stroke();
  ctx.lineWidth = 1.25;
  cross(ctx, at, TOOL_PX + 6, TOOL_PX);
  ctx.stroke();
}
