// Draws the hand: the spring from the bead to the pointer, and the keyboard's cursor.

import { pxFromWorld, type View } from './transform';
import { FONT } from './drawMap';
import { circle, cross } from './shapes';
import { distance, type Vec2 } from '../lab/geometry';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

const COIL_PX = 7;
const COIL_HALF_WIDTH_PX = 5;
/** Length of the straight wire at both ends of the coils. */
const LEAD_PX = 6;
const LABEL_OFFSET_PX = 16;
const LABEL_PADDING_PX = 6;
const LABEL_HEIGHT_PX = 20;

/** Corners of a zigzag spring from `a` to `b`, in pixels. */
function springPoints(a: Vec2, b: Vec2): [number, number][] {
  const length = distance(a, b);
  const coils = Math.floor((length - 2 * LEAD_PX) / COIL_PX);
  if (coils < 1)
    return [
      [a[0], a[1]],
      [b[0], b[1]],
    ];
  const along: Vec2 = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
  const lead = (length - coils * COIL_PX) / 2;
  const at = (s: number, side: number): [number, number] => [
    a[0] + along[0] * s - along[1] * side,
    a[1] + along[1] * s + along[0] * side,
  ];
  const points = [at(0, 0), at(lead, 0)];
  for (let i = 0; i < coils; i++) {
    const side = i % 2 === 0 ? COIL_HALF_WIDTH_PX : -COIL_HALF_WIDTH_PX;
    points.push(at(lead + (i + 0.5) * COIL_PX, side));
  }
  points.push(at(length - lead, 0), at(length, 0));
  return points;
}

function drawLabel(ctx: Ctx, text: string, at: Vec2, widthPx: number, palette: Palette): void {
  ctx.font = FONT;
  const width = ctx.measureText(text).width + 2 * LABEL_PADDING_PX;
  // To the left of the pointer if there is no space on the right.
  const left =
    at[0] + LABEL_OFFSET_PX + width > widthPx
      ? at[0] - LABEL_OFFSET_PX - width
      : at[0] + LABEL_OFFSET_PX;
  const top = Math.max(2, at[1] - LABEL_OFFSET_PX - LABEL_HEIGHT_PX);
  ctx.beginPath();
  ctx.roundRect(left, top, width, LABEL_HEIGHT_PX, 4);
  ctx.fillStyle = palette.surface;
  ctx.fill();
  ctx.strokeStyle = palette.you;
  ctx.lineWidth = 1;
  ctx.stroke();
  ctx.fillStyle = palette.ink;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'middle';
  ctx.fillText(text, left + LABEL_PADDING_PX, top + LABEL_HEIGHT_PX / 2 + 0.5);
}

export function drawSpring(
  ctx: Ctx,
  view: View,
  palette: Palette,
  widthPx: number,
  bead_m: Vec2,
  { hand_m, words }: { readonly hand_m: Vec2; readonly words: string },
): void {
  const bead = pxFromWorld(view, bead_m);
  const hand = pxFromWorld(view, hand_m);
  ctx.beginPath();
  for (const point of springPoints(bead, hand)) ctx.lineTo(...point);
  ctx.strokeStyle = palette.you;
  ctx.lineWidth = 1.75;
  ctx.lineJoin = 'round';
  ctx.stroke();
  circle(ctx, hand, 4);
  ctx.fillStyle = palette.you;
  ctx.fill();
  drawLabel(ctx, words, hand, widthPx, palette);
}

export function drawCursor(ctx: Ctx, view: View, palette: Palette, cursor: Vec2): void {
  ctx.strokeStyle = palette.accent;
  ctx.lineWidth = 2;
  cross(ctx, pxFromWorld(view, cursor), 14, 4);
  ctx.stroke();
}
