// The shown view as a source of pictures.

import type { Size } from '../ui/size';

export interface ViewPicture {
  /** In CSS pixels. */
  readonly size: Size;
  /**
   * Draws the view now. The canvas is valid until the next frame. It has `ratio` pixels per CSS pixel if the view can
   * draw that; undefined while there is nothing to draw.
   */
  draw(ratio: number): HTMLCanvasElement | undefined;
}
