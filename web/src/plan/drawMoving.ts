// What moves on the workspace, from the far layer to the near one.

import {
  GOAL_RADIUS_M,
  type OverlayMessage,
  type SceneMessage,
  type StateMessage,
} from '../net/protocol.gen';
import { pxFromWorld, type View } from './transform';
import type { Palette } from '../ui/palette';
import type { Vec2 } from '../lab/geometry';

/** The bead is 5 mm: on a small canvas it is drawn larger than life, or nobody finds it. */
const MIN_BEAD_PX = 4.5;
const TRACKED_PX = 4;
const TOOL_PX = 8;
/** Stands for a reach without an end: beyond every workspace. */
const BEYOND_M = 3;
/** Exponent of the superellipse that stands for an obstacle. */
const SUPERELLIPSE = 4;
const OUTLINE_POINTS = 40;

type Ctx = CanvasRenderingContext2D;

export function beadRadiusPx(view: View, radius_m: number): number {
  return Math.max(MIN_BEAD_PX, radius_m * view.pxPerM);
}

function circle(ctx: Ctx, [x, y]: Vec2, radius: number): void {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
}

function cross(ctx: Ctx, [x, y]: Vec2, half: number): void {
  ctx.beginPath();
  ctx.moveTo(x - half, y);
  ctx.lineTo(x + half, y);
  ctx.moveTo(x, y - half);
  ctx.lineTo(x, y + half);
  ctx.stroke();
}

export function drawFootprint(
  ctx: Ctx,
  view: View,
  palette: Palette,
  tool: Vec2,
  corners_m: SceneMessage['camera_sees_m'],
): void {
  ctx.beginPath();
  for (const [x_m, y_m] of corners_m) {
    ctx.lineTo(...pxFromWorld(view, [tool[0] + x_m, tool[1] + y_m]));
  }
  ctx.closePath();
  ctx.strokeStyle = palette.tool;
  ctx.globalAlpha = 0.45;
  ctx.lineWidth = 1;
  ctx.setLineDash([2, 3]);
  ctx.stroke();
  ctx.setLineDash([]);
  ctx.globalAlpha = 1;
}

/** Where the pull beats friction: a ring of sectors, since a turned block does not pull alike all round. */
export function drawCapture(
  ctx: Ctx,
  view: View,
  palette: Palette,
  tool: Vec2,
  capture_m: SceneMessage['capture_m'],
): void {
  const sector = (2 * Math.PI) / capture_m.length;
  const at = (k: number, distance_m: number): Vec2 =>
    pxFromWorld(view, [
      tool[0] + distance_m * Math.cos(k * sector),
      tool[1] + distance_m * Math.sin(k * sector),
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
  ctx.globalAlpha = 1;
}

export function drawSensed(ctx: Ctx, view: View, palette: Palette, overlay: OverlayMessage): void {
  ctx.strokeStyle = palette.sensed;
  ctx.fillStyle = palette.sensed;
  ctx.lineWidth = 1.5;
  for (const obstacle of overlay.obstacles) {
    const [x, y] = pxFromWorld(view, obstacle.center_m);
    const [halfX, halfY] = obstacle.half_size_m.map((half) => half * view.pxPerM) as [
      number,
      number,
    ];
    ctx.globalAlpha = 0.35;
    ctx.fillRect(x - halfX, y - halfY, 2 * halfX, 2 * halfY);
    ctx.globalAlpha = 1;
    ctx.beginPath();
    for (let i = 0; i < OUTLINE_POINTS; i++) {
      const angle = (2 * Math.PI * i) / OUTLINE_POINTS;
      const along = (value: number): number =>
        Math.sign(value) * Math.abs(value) ** (2 / SUPERELLIPSE);
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
    ctx.strokeStyle = palette.tool;
    ctx.strokeRect(x - 3, y - 3, 6, 6);
  }
}

/** `xs` and `ys` are world coordinates, oldest first. */
export function drawTrail(
  ctx: Ctx,
  view: View,
  color: string,
  xs: Float64Array,
  ys: Float64Array,
): void {
  // Beyond this many points a canvas a thousand pixels wide shows no difference.
  const stride = Math.max(1, Math.floor(xs.length / 800));
  ctx.beginPath();
  for (let i = xs.length - 1; i >= 0; i -= stride) {
    ctx.lineTo(...pxFromWorld(view, [xs[i] ?? 0, ys[i] ?? 0]));
  }
  ctx.strokeStyle = color;
  ctx.lineWidth = 1.5;
  ctx.lineJoin = 'round';
  ctx.globalAlpha = 0.6;
  ctx.stroke();
  ctx.globalAlpha = 1;
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
}

export function drawBead(
  ctx: Ctx,
  view: View,
  palette: Palette,
  scene: SceneMessage,
  state: StateMessage,
  canGrabRadiusPx: number | undefined,
): void {
  const at = pxFromWorld(view, [state.bead_m[0], state.bead_m[1]]);
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
  circle(ctx, at, beadRadiusPx(view, scene.bead_radius_m));
  ctx.fillStyle = palette.bead;
  ctx.fill();
  ctx.strokeStyle = palette.floor;
  ctx.lineWidth = 1.25;
  ctx.stroke();
  ctx.strokeStyle = palette.text;
  ctx.lineWidth = 1;
  cross(ctx, pxFromWorld(view, state.bead_tracked_m), TRACKED_PX);
}

export function drawTool(ctx: Ctx, view: View, palette: Palette, tool: Vec2): void {
  const at = pxFromWorld(view, tool);
  ctx.strokeStyle = palette.floor;
  ctx.lineWidth = 4;
  circle(ctx, at, TOOL_PX);
  ctx.stroke();
  ctx.strokeStyle = palette.tool;
  ctx.lineWidth = 2;
  ctx.stroke();
  ctx.lineWidth = 1.25;
  const [x, y] = at;
  ctx.beginPath();
  for (const [dx, dy] of [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
  ] as const) {
    ctx.moveTo(x + dx * TOOL_PX, y + dy * TOOL_PX);
    ctx.lineTo(x + dx * (TOOL_PX + 6), y + dy * (TOOL_PX + 6));
  }
  ctx.stroke();
}
