// Draws the camera's field of view and the obstacles in it.

import type { OverlayMessage } from '../../net/protocol.gen';
import type { BasePicture, MovingPicture } from '../../plan/layer';
import { pxFromWorld } from '../../plan/transform';
import type { Ctx } from '../../plan/sheet';

/** Exponent of the superellipse that represents an obstacle. */
const SUPERELLIPSE = 4;
const OUTLINE_POINTS = 40;

export function drawFootprint(ctx: Ctx, { view, palette, scene, state }: MovingPicture): void {
  const [toolX_m, toolY_m] = state.tool_m;
  ctx.beginPath();
  for (const [x_m, y_m] of scene.camera_sees_m) {
    ctx.lineTo(...pxFromWorld(view, [toolX_m + x_m, toolY_m + y_m]));
  }
  ctx.closePath();
  ctx.strokeStyle = palette.magnet;
  ctx.globalAlpha = 0.45;
  ctx.lineWidth = 1;
  ctx.lineJoin = 'round';
  ctx.setLineDash([2, 3]);
  ctx.stroke();
}

export function drawSensed(
  ctx: Ctx,
  { view, palette }: BasePicture,
  overlay: OverlayMessage,
): void {
  ctx.strokeStyle = palette.sensed;
  ctx.fillStyle = palette.sensed;
  ctx.lineWidth = 1.5;
  const along = (value: number): number => Math.sign(value) * Math.abs(value) ** (2 / SUPERELLIPSE);
  for (const obstacle of overlay.obstacles) {
    const [x, y] = pxFromWorld(view, obstacle.center_m);
    const [halfX_m, halfY_m] = obstacle.half_size_m;
    const [halfX, halfY] = [halfX_m * view.pxPerM, halfY_m * view.pxPerM];
    ctx.globalAlpha = 0.35;
    ctx.fillRect(x - halfX, y - halfY, 2 * halfX, 2 * halfY);
    ctx.globalAlpha = 1;
    ctx.beginPath();
    for (let i = 0; i < OUTLINE_POINTS; i++) {
      const angle = (2 * Math.PI * i) / OUTLINE_POINTS;
      const [edgeX, edgeY] = obstacle.boundary_m;
      ctx.lineTo(
        x + along(Math.cos(angle)) * edgeX * view.pxPerM,
        y - along(Math.sin(angle)) * edgeY * view.pxPerM,
      );
    }
    ctx.closePath();
    ctx.stroke();
  }
  if (overlay.target_m) {
    const [x, y] = pxFromWorld(view, overlay.target_m);
    ctx.strokeStyle = palette.magnet;
    ctx.strokeRect(x - 3, y - 3, 6, 6);
  }
}
