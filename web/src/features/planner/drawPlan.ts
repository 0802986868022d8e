// Draws ERRT's plan: the tree, the path with its clearance, and the obstacles.

import type { PlanLayer } from '../../net/protocol.gen';
import { strokeCased } from '../../plan/marks';
import type { BasePicture } from '../../plan/layer';
import { pxFromWorld, pxRect } from '../../plan/transform';
import type { Ctx } from '../../plan/sheet';

const CORNER_PX = 3;

export function drawPlan(ctx: Ctx, { view, palette }: BasePicture, plan: PlanLayer): void {
  const [tree, way, corners] = [new Path2D(), new Path2D(), new Path2D()];
  for (const [fromX, fromY, toX, toY] of plan.tree) {
    tree.moveTo(...pxFromWorld(view, [fromX, fromY]));
    tree.lineTo(...pxFromWorld(view, [toX, toY]));
  }
  for (const corner of plan.way) {
    const [x, y] = pxFromWorld(view, corner);
    way.lineTo(x, y);
    corners.moveTo(x + CORNER_PX, y);
    corners.arc(x, y, CORNER_PX, 0, 2 * Math.PI);
  }
  const colour = palette['m-errt'];
  ctx.strokeStyle = colour;
  ctx.lineWidth = 0.9;
  ctx.globalAlpha = 0.45;
  ctx.stroke(tree);
  ctx.lineJoin = 'round';
  ctx.lineCap = 'round';
  if (plan.clearance_m) {
    ctx.globalAlpha = 0.16;
    ctx.lineWidth = 2 * plan.clearance_m * view.pxPerM;
    ctx.stroke(way);
  }
  ctx.globalAlpha = 1;
  strokeCased(ctx, palette, { colour, width_px: 2 }, way);
  strokeCased(ctx, palette, { colour, width_px: 1 }, corners);
  ctx.fillStyle = colour;
  ctx.fill(corners);
}

export function drawObstacles(ctx: Ctx, { view, palette }: BasePicture, plan: PlanLayer): void {
  ctx.beginPath();
  for (const rect of plan.obstacles) ctx.rect(...pxRect(view, rect));
  strokeCased(ctx, palette, { colour: palette['m-errt'], width_px: 1, dash: [3, 2] });
}
