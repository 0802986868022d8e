// The walls as tissue: rim, lip, terraces around the lumen, light from the upper left, and a shadow on the floor. It is
// painted once per map, theme and view into bitmaps.

import type { Palette } from '../ui/palette';
import { rgb } from './colourRamp';
import type { Ctx } from './sheet';
import { tissueImage } from './tissue';
import { pxRect, type View } from './transform';
import { cornerPx, edgePath, framed, freePath, type Tray, reliefPx, trayPath, unitM } from './tray';

const RIM = 1.5;

/** Pictures of a part of the canvas, in device pixels. */
interface Shot {
  readonly view: View;
  readonly ratio: number;
  readonly left: number;
  readonly top: number;
  readonly isWhole: boolean;
  readonly width: number;
  readonly height: number;
  /** Walls and their shadow. */
  walls: HTMLCanvasElement | undefined;
  /** The tissue alone, without free places. */
  tissue: HTMLCanvasElement | undefined;
}

interface Softness {
  readonly colour: string;
  readonly blur: number;
  readonly to?: readonly [number, number];
}

/** Draws the blurred shadow of a shape without the shape. Filters would need a newer browser. */
function soften(
  ctx: Ctx,
  ratio: number,
  { colour, blur, to = [0, 0] }: Softness,
  draw: () => void,
): void {
  const away = 2 * Math.max(ctx.canvas.width, ctx.canvas.height);
  ctx.save();
  ctx.shadowColor = colour;
  ctx.shadowBlur = 2 * blur * ratio;
  ctx.shadowOffsetX = to[0] * ratio + away;
  ctx.shadowOffsetY = to[1] * ratio;
  ctx.translate(-away / ratio, 0);
  draw();
  ctx.restore();
}

export class Relief {
  private shots: readonly Shot[] = [];
  private image: HTMLCanvasElement | undefined;

  constructor(
    readonly tray: Tray,
    private readonly palette: Palette,
  ) {}

  /** Draws the walls and their shadow. While the view changes, earlier bitmaps are scaled. */
  draw(ctx: Ctx, view: View, isStill: boolean): void {
    for (const shot of this.shotsFor(ctx, view, isStill)) {
      shot.walls ??= this.paint(shot, (onto) => this.paintWalls(onto, shot));
      this.copy(ctx, view, shot, shot.walls);
    }
  }

  /** Draws tissue where `solid` is, for walls that are not at rest. */
  drawMoved(ctx: Ctx, view: View, isStill: boolean, solid: Path2D): void {
    ctx.save();
    ctx.clip(solid);
    for (const shot of this.shotsFor(ctx, view, isStill)) {
      this.copy(ctx, view, shot, this.tissueOf(shot));
    }
    ctx.restore();
  }

  /** The sharp bitmap of a view that is still; otherwise one of the whole tray, and the newest of a part of it. */
  private shotsFor(ctx: Ctx, view: View, isStill: boolean): readonly Shot[] {
    const ratio = ctx.getTransform().a;
    const sharp = this.shots.find((shot) => shot.ratio === ratio && isSame(shot.view, view));
    if (sharp) return [sharp];
    const whole = this.shots.find(({ isWhole }) => isWhole);
    if (!isStill && whole) return this.shots;
    const shot = this.shoot(ctx.canvas, view, ratio);
    this.shots = shot.isWhole || !whole ? [shot] : [whole, shot];
    return [shot];
  }

  private shoot({ width, height }: HTMLCanvasElement, view: View, ratio: number): Shot {
    const [x, y, wide, high] = pxRect(view, framed(this.tray.workspace)).map(
      (px) => px * ratio,
    ) as [number, number, number, number];
    const [left, top] = [Math.max(0, Math.floor(x)), Math.max(0, Math.floor(y))];
    const [right, bottom] = [
      Math.min(width, Math.ceil(x + wide)),
      Math.min(height, Math.ceil(y + high)),
    ];
    const isWhole = x >= -1 && y >= -1 && x + wide <= width + 1 && y + high <= height + 1;
    return {
      ...{ view, ratio, left, top, isWhole, walls: undefined, tissue: undefined },
      width: Math.max(1, right - left),
      height: Math.max(1, bottom - top),
    };
  }

  private tissueOf(shot: Shot): HTMLCanvasElement {
    return (shot.tissue ??= this.paint(shot, (ctx) => this.paintTissue(ctx, shot)));
  }

  private copy(ctx: Ctx, view: View, shot: Shot, from: HTMLCanvasElement): void {
    ctx.save();
    if (isSame(shot.view, view)) {
      ctx.resetTransform();
      ctx.drawImage(from, shot.left, shot.top);
    } else {
      const scale = view.pxPerM / shot.view.pxPerM;
      const x = view.originX + (shot.left / shot.ratio - shot.view.originX) * scale;
      const y = view.originY + (shot.top / shot.ratio - shot.view.originY) * scale;
      const [width, height] = [from.width, from.height].map((px) => (px / shot.ratio) * scale);
      ctx.drawImage(from, x, y, width ?? 0, height ?? 0);
    }
    ctx.restore();
  }

  private paint(
    { left, top, ratio, width, height }: Shot,
    draw: (ctx: Ctx) => void,
  ): HTMLCanvasElement {
    const canvas = document.createElement('canvas');
    canvas.width = width;
    canvas.height = height;
    const ctx = canvas.getContext('2d');
    ctx?.setTransform(ratio, 0, 0, ratio, -left, -top);
    if (ctx) draw(ctx);
    return canvas;
  }

  private paintTissue(ctx: Ctx, { view }: Shot): void {
    const { palette, tray } = this;
    const unit = unitM(tray.workspace) * view.pxPerM;
    const [left, top, width, height] = pxRect(view, framed(tray.workspace));
    ctx.save();
    ctx.clip(trayPath(tray.workspace, view));
    this.image ??= tissueImage(tray, palette);
    if (this.image) ctx.drawImage(this.image, left, top, width, height);
    const light = ctx.createLinearGradient(left, top, left + 0.35 * width, top + height);
    light.addColorStop(0, 'rgb(255 255 255 / 0.04)');
    light.addColorStop(0.6, 'rgb(255 255 255 / 0)');
    light.addColorStop(1, 'rgb(58 15 12 / 0.08)');
    ctx.fillStyle = light;
    ctx.fillRect(left, top, width, height);
    const inset = 0.8 * unit;
    ctx.beginPath();
    ctx.roundRect(
      ...([left + inset, top + inset, width - 2 * inset, height - 2 * inset] as const),
      cornerPx(tray.workspace, view) - inset,
    );
    ctx.strokeStyle = 'rgb(255 255 255 / 0.28)';
    ctx.lineWidth = 1.4 * unit;
    ctx.stroke();
    ctx.restore();
  }

  private paintWalls(ctx: Ctx, shot: Shot): void {
    const { palette, tray } = this;
    const { view, ratio } = shot;
    const unit = reliefPx(tray.workspace, view);
    const [free, edge] = [freePath(tray, view), edgePath(tray, view)];
    const solid = trayPath(tray.workspace, view);
    solid.addPath(free);
    ctx.save();
    ctx.resetTransform();
    ctx.drawImage(this.tissueOf(shot), 0, 0);
    ctx.restore();
    ctx.lineJoin = 'round';
    ctx.save();
    ctx.clip(solid, 'evenodd');
    soften(
      ctx,
      ratio,
      { colour: 'rgb(255 255 255 / 0.17)', blur: 1.2 * unit, to: [1.5 * unit, 2 * unit] },
      () => {
        ctx.lineWidth = 2.6 * unit;
        ctx.stroke(edge);
      },
    );
    ctx.restore();
    // The tissue covers the free places too: they become clear again, up to the middle of the rim.
    ctx.save();
    ctx.globalCompositeOperation = 'destination-out';
    ctx.fill(free, 'evenodd');
    ctx.restore();
    ctx.save();
    ctx.clip(free, 'evenodd');
    const shade = (opacity: number): string =>
      `rgb(${rgb(palette['wall-shade']).join(' ')} / ${String(opacity)})`;
    for (const [opacity, blur, x, y] of [
      [0.34, 4.2, 3, 5.5],
      [0.16, 1.2, 1.2, 2],
    ] as const) {
      soften(
        ctx,
        ratio,
        { colour: shade(opacity), blur: blur * unit, to: [x * unit, y * unit] },
        () => ctx.fill(solid, 'evenodd'),
      );
    }
    ctx.restore();
    ctx.strokeStyle = palette['wall-rim'];
    ctx.lineWidth = RIM * unit;
    ctx.stroke(edge);
  }
}

const isSame = (a: View, b: View): boolean =>
  a.pxPerM === b.pxPerM && a.originX === b.originX && a.originY === b.originY;
