// Draws the camera's field of view and the obstacles in it.

import type { OverlayMessage } from '../../net/protocol.gen';
import { between, distance, type Vec2 } from '../../lab/geometry';
import { strokeCased } from '../../plan/marks';
import type { BasePicture, MovingPicture } from '../../plan/layer';
import { pxFromWorld } from '../../plan/transform';
import type { Ctx } from '../../plan/sheet';

/** Exponent of the superellipse that represents an obstacle. */
const SUPERELLIPSE = 4;
const OUTLINE_POINTS = 40;
const BRACKET_PX = 18;

/** Brackets at the corners of what the camera sees. */
export function drawFootprint(ctx: Ctx, { view, palette, scene, state }: MovingPicture): void {
  const [toolX_m, toolY_m] = state.tool_m;
  const corners = scene.camera_sees_m.map(([x_m, y_m]) =>
    pxFromWorld(view, [toolX_m + x_m, toolY_m + y_m]),
  );
  ctx.beginPath();
  corners.forEach((corner, i) => {
    const toward = (other: Vec2 | undefined): Vec2 => {
      if (!other) return corner;
      return between(corner, other, Math.min(1, BRACKET_PX / Math.max(1, distance(corner, other))));
    };
    ctx.moveTo(...toward(corners.at(i - 1)));
    ctx.lineTo(...corner);
    ctx.lineTo(...toward(corners[(i + 1) % corners.length]));
  });
  strokeCased(ctx, palette, { colour: palette.magnet, width_px: 2.2 });
}

export function drawSensed(
  ctx: Ctx,
  { view, palette }: BasePicture,
  overlay: OverlayMessage,
): void {
  ctx.fillStyle = palette.sensed;
  const along = (value: number): number => Math.sign(value) * Math.abs(value) ** (2 / SUPERELLIPSE);
  for (const obstacle of overlay.obstacles) {
    const [x, y] = pxFromWorld(view, obstacle.center_m);
    const [halfX_m, halfY_m] = obstacle.half_size_m;
    const [halfX, halfY] = [halfX_m * view.pxPerM, halfY_m * view.pxPerM];
    ctx.globalAlpha = 0.3;
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
    strokeCased(ctx, palette, { colour: palette.sensed, width_px: 1.6 });
  }
  if (overlay.target_m) {
    const [x, y] = pxFromWorld(view, overlay.target_m);
    ctx.beginPath();
    ctx.rect(x - 4, y - 4, 8, 8);
    strokeCased(ctx, palette, { colour: palette.magnet, width_px: 2 });
  }
}
