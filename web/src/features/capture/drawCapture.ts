// Draws where the magnet captures the bead.

import type { Vec2 } from '../../lab/geometry';
import type { MovingPicture } from '../../plan/layer';
import { pxFromWorld } from '../../plan/transform';

/** Used for a reach without an end: larger than any workspace. */
export const BEYOND_M = 3;

/** Where the pull is stronger than friction: a ring of sectors, because a turned block pulls differently in each direction. */
export function drawCapture(
  ctx: CanvasRenderingContext2D,
  { view, palette, scene, state }: MovingPicture,
): void {
  const { capture_m } = scene;
  const [toolX_m, toolY_m] = state.tool_m;
  const sector = (2 * Math.PI) / capture_m.length;
  const at = (k: number, distance_m: number): Vec2 =>
    pxFromWorld(view, [
      toolX_m + distance_m * Math.cos(k * sector),
      toolY_m + distance_m * Math.sin(k * sector),
    ]);
  const fill = new Path2D();
  const edge = new Path2D();
  capture_m.forEach((reach, k) => {
    const next = capture_m[(k + 1) % capture_m.length];
    if (!reach || !next) return;
    const far = (span: NonNullable<typeof reach>): number => span[1] ?? BEYOND_M;
    const [innerA, innerB] = [at(k, reach[0]), at(k + 1, next[0])];
    const [outerA, outerB] = [at(k, far(reach)), at(k + 1, far(next))];
    fill.moveTo(...innerA);
    fill.lineTo(...outerA);
    fill.lineTo(...outerB);
    fill.lineTo(...innerB);
    fill.closePath();
    edge.moveTo(...outerA);
    edge.lineTo(...outerB);
    edge.moveTo(...innerA);
    edge.lineTo(...innerB);
  });
  ctx.fillStyle = palette.tool;
  ctx.globalAlpha = 0.07;
  ctx.fill(fill);
  ctx.globalAlpha = 0.8;
  ctx.strokeStyle = palette.tool;
  ctx.lineWidth = 1.25;
  ctx.stroke(edge);
}
