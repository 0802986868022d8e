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
  /** Colour of the casing, if it is another one than usual. */
  readonly edge?: string;
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
  ctx.strokeStyle = line.edge ?? palette.case;
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
  at: Vec2,
  { align, isTurned }: { align: CanvasTextAlign; isTurned: boolean | undefined },
): void {
  ctx.save();
  ctx.translate(...at);
  if (isTurned) ctx.rotate(-Math.PI / 2);
  ctx.font = LABEL_FONT;
  ctx.textAlign = align;
  ctx.textBaseline = 'middle';
  ctx.lineJoin = 'round';
  ctx.strokeStyle = palette.case;
  ctx.lineWidth = LABEL_CASE_PX;
  ctx.strokeText(text, 0, 0);
  ctx.fillStyle = palette['m-ink'];
  ctx.fillText(text, 0, 0);
  ctx.restore();
}

type Box = readonly [left: number, top: number, right: number, bottom: number];

const areApart = (a: Box, b: Box): boolean =>
  a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1];

/** Labels of one picture: each goes beside its mark where no other mark or label is. */
export class Labels {
  private readonly taken: Box[] = [];

  constructor(private readonly isTurned = false) {}

  /** Keeps a mark free. */
  keep([x, y]: Vec2, radius_px: number): void {
    this.taken.push([x - radius_px, y - radius_px, x + radius_px, y + radius_px]);
  }

  /** To the right of a place, otherwise above, below or to the left. */
  draw(ctx: Ctx, palette: Palette, text: string, [x, y]: Vec2, away_px: number): void {
    ctx.font = LABEL_FONT;
    const [halfWide, halfHigh] = [ctx.measureText(text).width / 2, LABEL_HEIGHT_PX / 2];
    const { isTurned } = this;
    const [halfX, halfY] = isTurned ? [halfHigh, halfWide] : [halfWide, halfHigh];
    /** Around a middle to the right of the place and below it, as the page shows them. */
    const boxAt = (right: number, below: number): Box => {
      const [middleX, middleY] = isTurned ? [x + below, y - right] : [x + right, y + below];
      return [middleX - halfX, middleY - halfY, middleX + halfX, middleY + halfY];
    };
    const aside = away_px + halfWide;
    const over = away_px + halfHigh;
    const boxes = [0, 1, 2, 3, 4]
      .map((line) => line * LABEL_HEIGHT_PX)
      .flatMap((more) => [
        boxAt(aside + more, 0),
        boxAt(0, -over - more),
        boxAt(0, over + more),
        boxAt(-aside - more, 0),
      ]);
    const { a: ratio } = ctx.getTransform();
    const isFree = (box: Box): boolean =>
      Math.min(box[0], box[1]) > 2 &&
      box[2] < ctx.canvas.width / ratio - 2 &&
      box[3] < ctx.canvas.height / ratio - 2 &&
      this.taken.every((one) => areApart(one, box));
    const box = boxes.find(isFree) ?? boxAt(aside, 0);
    this.taken.push(box);
    const middle: Vec2 = [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2];
    drawText(ctx, palette, text, middle, { align: 'center', isTurned });
  }
}
