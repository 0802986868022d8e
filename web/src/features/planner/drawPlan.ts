// Draws ERRT's plan: the tree, the path with its clearance, and the obstacles.

import type { Palette } from '../../ui/palette';
import type { PlanLayer } from '../../net/protocol.gen';
import { pxFromWorld, type View } from '../../plan/transform';

type Ctx = CanvasRenderingContext2D;

const CORNER_PX = 3;

/** Path2D objects, kept so that a tree of thousands of edges is not traced for every frame. */
export interface Plan {
  readonly tree: Path2D;
  readonly way: Path2D;
  readonly corners: Path2D;
  readonly bandPx: number;
}

export function createPlan(layer: PlanLayer, view: View): Plan {
  const [tree, way, corners] = [new Path2D(), new Path2D(), new Path2D()];
  for (const [fromX, fromY, toX, toY] of layer.tree) {
    tree.moveTo(...pxFromWorld(view, [fromX, fromY]));
    tree.lineTo(...pxFromWorld(view, [toX, toY]));
  }
  for (const corner of layer.way) {
    const [x, y] = pxFromWorld(view, corner);
    way.lineTo(x, y);
    corners.moveTo(x + CORNER_PX, y);
    corners.arc(x, y, CORNER_PX, 0, 2 * Math.PI);
  }
  const bandPx = 2 * (layer.clearance_m ?? 0) * view.pxPerM;
  return { tree, way, corners, bandPx };
}

export function drawPlan(ctx: Ctx, palette: Palette, plan: Plan): void {
  ctx.strokeStyle = palette.plan;
  ctx.lineWidth = 0.75;
  ctx.globalAlpha = 0.35;
  ctx.stroke(plan.tree);
  ctx.lineJoin = 'round';
  ctx.lineCap = 'round';
  if (plan.bandPx > 0) {
    ctx.globalAlpha = 0.16;
    ctx.lineWidth = plan.bandPx;
    ctx.stroke(plan.way);
  }
  ctx.globalAlpha = 1;
  ctx.lineWidth = 2;
  ctx.stroke(plan.way);
  ctx.lineCap = 'butt';
  ctx.fillStyle = palette.plan;
  ctx.fill(plan.corners);
}

export function createObstacles(layer: PlanLayer, view: View): Path2D {
  const obstacles = new Path2D();
  for (const rect of layer.obstacles) {
    const [left, top] = pxFromWorld(view, [rect.x_min_m, rect.y_max_m]);
    const [right, bottom] = pxFromWorld(view, [rect.x_max_m, rect.y_min_m]);
    obstacles.rect(left, top, right - left, bottom - top);
  }
  return obstacles;
}

export function drawObstacles(ctx: Ctx, palette: Palette, obstacles: Path2D): void {
  ctx.strokeStyle = palette.plan;
  ctx.lineWidth = 0.75;
  ctx.globalAlpha = 0.7;
  ctx.stroke(obstacles);
  ctx.globalAlpha = 1;
}
