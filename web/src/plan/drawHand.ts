// Draws the hand: the arrow from the bead to the pointer, and the keyboard's cursor.

import { pxFromWorld, type View } from './transform';
import { Labels, strokeCased } from './marks';
import { cross } from './shapes';
import { distance, type Vec2 } from '../lab/geometry';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

const DASH = [7, 5];
const HEAD_PX = 10;
const LABEL_OFFSET_PX = 16;

/** How the hand pulls the bead. */
export function drawPull(
  ctx: Ctx,
  view: View,
  palette: Palette,
  bead_m: Vec2,
  { hand_m, words }: { readonly hand_m: Vec2; readonly words: string },
): void {
  const bead = pxFromWorld(view, bead_m);
  const hand = pxFromWorld(view, hand_m);
  const length = distance(bead, hand);
  const colour = palette['m-you'];
  if (length > HEAD_PX) {
    const [x, y] = [(hand[0] - bead[0]) / length, (hand[1] - bead[1]) / length];
    ctx.beginPath();
    ctx.moveTo(...bead);
    ctx.lineTo(hand[0] - x * HEAD_PX * 0.6, hand[1] - y * HEAD_PX * 0.6);
    strokeCased(ctx, palette, { colour, width_px: 3, dash: DASH });
    const corner = (side: number): Vec2 => [
      hand[0] - HEAD_PX * (x - side * 0.62 * y),
      hand[1] - HEAD_PX * (y + side * 0.62 * x),
    ];
    ctx.beginPath();
    ctx.moveTo(...corner(1));
    ctx.lineTo(...hand);
    ctx.lineTo(...corner(-1));
    ctx.closePath();
    strokeCased(ctx, palette, { colour, width_px: 1.5 });
    ctx.fillStyle = colour;
    ctx.fill();
  }
  new Labels(view.isTurned).draw(ctx, palette, words, hand, LABEL_OFFSET_PX);
}

export function drawCursor(ctx: Ctx, view: View, palette: Palette, cursor: Vec2): void {
  cross(ctx, pxFromWorld(view, cursor), 14, 4);
  strokeCased(ctx, palette, { colour: palette['m-cursor'], width_px: 2 });
}
