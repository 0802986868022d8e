// Canvases that are cleared, and such that are kept.

import type { Size } from '../ui/size';

export type Ctx = CanvasRenderingContext2D;

/** The canvas, cleared, with one unit per CSS pixel. */
export function contextOf(
  canvas: HTMLCanvasElement,
  size: Size,
  ratio = window.devicePixelRatio,
): Ctx | null {
  const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const ctx = canvas.getContext('2d');
  ctx?.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx?.clearRect(0, 0, size.width, size.height);
  return ctx;
}

/** A part of a picture. It is painted again only for another input, which changes with the size, or another ratio. */
export class Sheet<T> {
  private readonly canvas = document.createElement('canvas');
  private input: T | undefined;
  private ratio = 0;

  constructor(private readonly paint: (ctx: Ctx, input: T, size: Size, ratio: number) => void) {}

  /** Copies it onto a canvas of the same size. */
  copy(onto: Ctx, input: T, size: Size, ratio: number): void {
    if (input !== this.input || ratio !== this.ratio) {
      const ctx = contextOf(this.canvas, size, ratio);
      if (ctx) this.paint(ctx, input, size, ratio);
      [this.input, this.ratio] = [input, ratio];
    }
    onto.save();
    onto.resetTransform();
    onto.drawImage(this.canvas, 0, 0);
    onto.restore();
  }
}
