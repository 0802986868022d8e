// Fog over what the camera has not seen.

import type { Rect, SeenMessage } from '../net/protocol.gen';
import { UNKNOWN } from '../lab/obstacleMap';
import { drawClipped } from './baseMap';
import type { BasePicture } from './layer';
import { pxRect, type View } from './transform';

/** A row of cells: row, first column, and the column after the last. */
export type Span = readonly [row: number, from: number, to: number];

/** The cells that the camera has not seen, row by row. */
export function unseenSpans({ columns, runs }: Pick<SeenMessage, 'columns' | 'runs'>): Span[] {
  const spans: Span[] = [];
  let cell = 0;
  for (const [state, count] of runs) {
    const end = cell + count;
    while (cell < end) {
      const [row, from] = [Math.floor(cell / columns), cell % columns];
      const to = Math.min(columns, from + end - cell);
      if (state === UNKNOWN) spans.push([row, from, to]);
      cell += to - from;
    }
  }
  return spans;
}

/** The fog as a path in a view; everything before the first obstacle map. */
export function fogPath(seen: SeenMessage | undefined, workspace: Rect, view: View): Path2D {
  const path = new Path2D();
  const [left, top, width, height] = pxRect(view, workspace);
  if (!seen) {
    path.rect(left, top, width, height);
    return path;
  }
  const [bottom, wide, high] = [top + height, width / seen.columns, height / seen.rows];
  // Whole pixels, so that nothing shines through between two rows.
  const at = (place: number): number => Math.round(place);
  for (const [row, from, to] of unseenSpans(seen)) {
    const [x0, x1] = [at(left + from * wide), at(left + to * wide)];
    const [y0, y1] = [at(bottom - (row + 1) * high), at(bottom - row * high)];
    path.rect(x0, y0, x1 - x0, y1 - y0);
  }
  return path;
}

export function drawFog(ctx: CanvasRenderingContext2D, picture: BasePicture, fog: Path2D): void {
  drawClipped(ctx, picture, () => {
    ctx.fillStyle = picture.palette.fog;
    ctx.fill(fog);
  });
}
