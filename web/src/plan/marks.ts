// What all marks on the map share: a casing, so that they show on floor and wall, and labels in ink on it.

import { type Controller, dashOf, LOOKS, SHAPE_PX } from '../ui/controllers';
import type { Palette } from '../ui/palette';
import type { Vec2 } from '../lab/geometry';
import type { Ctx } from './sheet';

/** On each side of a line. */
const CASE_PX = 1.7;
const LABEL_CASE_PX = 5;
const HEAD_SCALE = 1.35;
export const LABEL_FONT = "640 13px 'Inter Variable', system-ui, sans-serif";
const LABEL_HEIGHT_PX = 16;

export interface Line {
  readonly colour: string;
  readonly width_px: number;
  readonly dash?: readonly number[];
}

/** Draws a line over its casing: the present path, or another one. */
export function strokeCased(ctx: Ctx, palette: Palette, line: Line, path?: Path2D): void {
  const stroke = (): void => {
    if (path) ctx.stroke(path);
    else ctx.stroke();
  };
  ctx.save();
  ctx.lineJoin = 'round';
  ctx.lineCap = 'round';
  ctx.strokeStyle = palette.case;
  ctx.lineWidth = line.width_px + 2 * CASE_PX;
  stroke();
  ctx.strokeStyle = line.colour;
  ctx.lineWidth = line.width_px;
  ctx.setLineDash([...(line.dash ?? [])]);
  if (line.dash && line.dash.length > 0 && (line.dash[0] ?? 0) > 1) ctx.lineCap = 'butt';
  stroke();
  ctx.restore();
}

export const lineOf = (palette: Palette, controller: Controller, width_px: number): Line => ({
  colour: palette[LOOKS[controller].mark],
  width_px,
  dash: dashOf(controller, width_px),
});

/** The shape of a controller, at the head of what it has done. */
export function drawHead(ctx: Ctx, palette: Palette, controller: Controller, [x, y]: Vec2): void {
  const { shape, mark } = LOOKS[controller];
  const path = new Path2D(shape);
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(HEAD_SCALE, HEAD_SCALE);
  ctx.translate(-SHAPE_PX / 2, -SHAPE_PX / 2);
  ctx.lineJoin = 'round';
  ctx.strokeStyle = palette.case;
  ctx.lineWidth = (2 * CASE_PX) / HEAD_SCALE;
  ctx.stroke(path);
  ctx.fillStyle = palette[mark];
  ctx.fill(path);
  ctx.restore();
}

/** Text that is readable on floor and wall. */
export function drawText(
  ctx: Ctx,
  palette: Palette,
  text: string,
  [x, y]: Vec2,
  align: CanvasTextAlign = 'left',
): void {
  ctx.save();
  ctx.font = LABEL_FONT;
  ctx.textAlign = align;
  ctx.textBaseline = 'middle';
  ctx.lineJoin = 'round';
  ctx.strokeStyle = palette.case;
  ctx.lineWidth = LABEL_CASE_PX;
  ctx.strokeText(text, x, y);
  ctx.fillStyle = palette['m-ink'];
  ctx.fillText(text, x, y);
  ctx.restore();
}

type Box = readonly [left: number, top: number, right: number, bottom: number];

const areApart = (a: Box, b: Box): boolean =>
  a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1];

/** Labels of one picture: each goes beside its mark where no other mark or label is. */
export class Labels {
  private readonly taken: Box[] = [];

  /** Keeps a mark free. */
  keep([x, y]: Vec2, radius_px: number): void {
    this.taken.push([x - radius_px, y - radius_px, x + radius_px, y + radius_px]);
  }

  /** To the right of a place, otherwise above, below or to the left. */
  draw(ctx: Ctx, palette: Palette, text: string, [x, y]: Vec2, away_px: number): void {
    ctx.font = LABEL_FONT;
    const width = ctx.measureText(text).width;
    const half = LABEL_HEIGHT_PX / 2;
    const boxAt = (middleX: number, middleY: number): Box => [
      middleX - width / 2,
      middleY - half,
      middleX + width / 2,
      middleY + half,
    ];
    const aside = away_px + width / 2;
    const over = away_px + half;
    const boxes = [
      boxAt(x + aside, y),
      boxAt(x, y - over),
      boxAt(x, y + over),
      boxAt(x - aside, y),
      ...[1, 2, 3].map((line) => boxAt(x, y + over + line * LABEL_HEIGHT_PX)),
    ];
    const edge = ctx.canvas.width / ctx.getTransform().a;
    const isFree = (box: Box): boolean =>
      box[0] > 2 &&
      box[2] < edge - 2 &&
      box[1] > 2 &&
      this.taken.every((one) => areApart(one, box));
    const box = boxes.find(isFree) ?? boxAt(x + aside, y);
    this.taken.push(box);
    drawText(ctx, palette, text, [box[0], box[1] + half]);
  }
}
