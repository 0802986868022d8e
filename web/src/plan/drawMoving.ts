// Draws the moving parts of the workspace, from back to front.

import { GOAL_RADIUS_M } from '../net/protocol.gen';
import { pxFromWorld, type View } from './transform';
import type { Vec2 } from '../lab/geometry';
import { strokeCased } from './marks';
import { circle, cross } from './shapes';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

/** The bead has a diameter of 5 mm. It is enlarged to be seen and taken, but less in a near view. */
const BEAD_ENLARGED = 2.6;
const MIN_BEAD_PX = 5.5;
const MOST_ENLARGED_PX = 10;
const RING_PX = 21;
const RING_DASH = [4, 3.6];
const TRACKED_PX = 3.5;
const TOOL_PX = 16;
const TOOL_BAND_PX = 5.5;
/** Half of the gap between the poles. */
const POLE_GAP_RAD = 0.15;
const START_PX = 5;
const PULL_DASH = [7, 5];

export function beadRadiusPx(view: View, radius_m: number): number {
  const true_px = radius_m * view.pxPerM;
  return Math.max(MIN_BEAD_PX, true_px, Math.min(BEAD_ENLARGED * true_px, MOST_ENLARGED_PX));
}

export function drawStart(ctx: Ctx, view: View, palette: Palette, start: Vec2): void {
  circle(ctx, pxFromWorld(view, start), START_PX);
  ctx.fillStyle = palette.case;
  ctx.fill();
  strokeCased(ctx, palette, { colour: palette['m-ink'], width_px: 2 });
}

export function drawGoal(ctx: Ctx, view: View, palette: Palette, goal: Vec2): void {
  const [x, y] = pxFromWorld(view, goal);
  const radius = GOAL_RADIUS_M * view.pxPerM;
  const colour = palette['m-goal'];
  ctx.save();
  circle(ctx, [x, y], radius);
  ctx.fillStyle = colour;
  ctx.globalAlpha = 0.14;
  ctx.fill();
  ctx.globalAlpha = 1;
  strokeCased(ctx, palette, { colour, width_px: 3 });
  const scale = Math.min(2.2, Math.max(0.5, radius / 20));
  const flag = new Path2D();
  flag.moveTo(-3.4, 7.5);
  flag.lineTo(-3.4, -7.5);
  flag.lineTo(5.6, -3.9);
  flag.lineTo(-3.4, -0.3);
  ctx.translate(x, y);
  if (view.isTurned) ctx.rotate(-Math.PI / 2);
  ctx.scale(scale, scale);
  ctx.fillStyle = colour;
  ctx.fill(flag);
  ctx.strokeStyle = colour;
  ctx.lineWidth = 1.8;
  ctx.lineJoin = 'round';
  ctx.lineCap = 'round';
  ctx.stroke(flag);
  ctx.restore();
}

/** Shows that the bead can be taken; `isNear` when a press would do so. */
export function drawGrabRing(
  ctx: Ctx,
  view: View,
  palette: Palette,
  bead: Vec2,
  isNear: boolean,
): void {
  circle(ctx, pxFromWorld(view, bead), RING_PX);
  ctx.fillStyle = palette.bead;
  ctx.globalAlpha = isNear ? 0.5 : 0.26;
  ctx.fill();
  ctx.globalAlpha = 1;
  const dash = isNear ? [] : RING_DASH;
  strokeCased(ctx, palette, { colour: palette['bead-edge'], width_px: 1.8, dash });
}

export function drawBead(
  ctx: Ctx,
  view: View,
  palette: Palette,
  bead: Vec2,
  radius_m: number,
): void {
  const [x, y] = pxFromWorld(view, bead);
  const radius = beadRadiusPx(view, radius_m);
  circle(ctx, [x, y], radius);
  strokeCased(ctx, palette, { colour: palette['bead-edge'], width_px: 2.4 });
  ctx.fillStyle = palette.bead;
  ctx.fill();
  const light = ctx.createRadialGradient(
    x - 0.28 * radius,
    y - 0.36 * radius,
    0,
    x - 0.28 * radius,
    y - 0.36 * radius,
    1.6 * radius,
  );
  light.addColorStop(0, 'rgb(255 255 255 / 0.55)');
  light.addColorStop(0.5, 'rgb(255 255 255 / 0)');
  light.addColorStop(1, 'rgb(90 40 0 / 0.5)');
  ctx.fillStyle = light;
  ctx.fill();
  circle(ctx, [x - 0.32 * radius, y - 0.35 * radius], 0.22 * radius);
  ctx.fillStyle = 'rgb(255 255 255 / 0.85)';
  ctx.fill();
}

export function drawTracked(ctx: Ctx, view: View, palette: Palette, tracked: Vec2): void {
  ctx.strokeStyle = palette['bead-edge'];
  ctx.lineWidth = 1.2;
  cross(ctx, pxFromWorld(view, tracked), TRACKED_PX);
  ctx.stroke();
}

/** A dashed line from the tool to where the hand points it. */
export function drawSteering(ctx: Ctx, view: View, palette: Palette, tool: Vec2, to: Vec2): void {
  const [from, at] = [pxFromWorld(view, tool), pxFromWorld(view, to)];
  const colour = palette['m-you'];
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...at);
  strokeCased(ctx, palette, { colour, width_px: 2, dash: PULL_DASH });
  circle(ctx, at, 6);
  strokeCased(ctx, palette, { colour, width_px: 2.2 });
}

/** A ring with a north and a south half: the bead is seen through it. */
export function drawTool(ctx: Ctx, view: View, palette: Palette, tool: Vec2): void {
  const [x, y] = pxFromWorld(view, tool);
  ctx.save();
  circle(ctx, [x, y], TOOL_PX);
  ctx.strokeStyle = palette.case;
  ctx.lineWidth = TOOL_BAND_PX + 3.4;
  ctx.stroke();
  ctx.lineWidth = TOOL_BAND_PX;
  for (const [colour, middle] of [
    [palette.north, Math.PI],
    [palette.south, 0],
  ] as const) {
    const half = Math.PI / 2 - POLE_GAP_RAD;
    ctx.beginPath();
    ctx.arc(x, y, TOOL_PX, middle - half, middle + half);
    ctx.strokeStyle = colour;
    ctx.stroke();
  }
  cross(ctx, [x, y], 4.5);
  strokeCased(ctx, palette, { colour: palette.magnet, width_px: 2 });
  ctx.restore();
}
