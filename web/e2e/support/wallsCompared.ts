// Compares the walls that Ferry reads with what the browser draws. Runs in the page.

import type { MapCheck } from '../../src/net/protocol.gen';

export interface Difference {
  /** Pixels that the browser paints farther than the tolerance from a wall, and the other way round. */
  readonly missing: number;
  readonly extra: number;
  /** The first of them, in units of the drawing. */
  readonly at: readonly [number, number];
}

/** `drawing` is an address. The page gets this function alone. */
export async function wallsCompared({
  drawing,
  check,
}: {
  drawing: string;
  check: MapCheck;
}): Promise<Difference | null> {
  const MOST_PIXELS = 2e6;
  // Less is nothing that one can see.
  const SEEN = 8;
  const { x_min_m, x_max_m, y_min_m, y_max_m } = check.workspace;
  const [width_mm, height_mm] = [1000 * (x_max_m - x_min_m), 1000 * (y_max_m - y_min_m)];
  const perMm = Math.min(4, Math.sqrt(MOST_PIXELS / (width_mm * height_mm)));
  // A large drawing has large pixels.
  const tolerance_mm = Math.max(0.5, 0.75 / perMm);
  const [width, height] = [Math.round(width_mm * perMm), Math.round(height_mm * perMm)];
  const image = new Image();
  image.src = drawing;
  await image.decode();
  const alphas = (paint: (on: OffscreenCanvasRenderingContext2D) => void) => {
    const on = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    if (on === null) throw new Error('no canvas');
    paint(on);
    const { data } = on.getImageData(0, 0, width, height);
    return data.filter((_, i) => i % 4 === 3);
  };
  const walls = new Path2D();
  for (const ring of check.outlines.flatMap(({ exterior, holes }) => [exterior, ...holes])) {
    for (const [i, [x_m, y_m]] of ring.entries()) {
      const [x, y] = [1000 * perMm * (x_m - x_min_m), 1000 * perMm * (y_max_m - y_m)];
      if (i === 0) walls.moveTo(x, y);
      else walls.lineTo(x, y);
    }
    walls.closePath();
  }
  const outlined = (operation: GlobalCompositeOperation) =>
    alphas((on) => {
      on.fill(walls, 'evenodd');
      on.globalCompositeOperation = operation;
      on.lineJoin = 'round';
      on.lineWidth = 2 * tolerance_mm * perMm;
      on.stroke(walls);
    });
  const [grown, shrunk] = [outlined('source-over'), outlined('destination-out')];
  const drawn = alphas((on) => {
    on.drawImage(image, 0, 0, width, height);
  });
  let [missing, extra, first] = [0, 0, -1];
  for (const [i, alpha] of drawn.entries()) {
    const isMissing = alpha > SEEN && grown[i] === 0;
    const isExtra = alpha <= SEEN && shrunk[i] === 255;
    if (!isMissing && !isExtra) continue;
    missing += Number(isMissing);
    extra += Number(isExtra);
    if (first < 0) first = i;
  }
  if (first < 0) return null;
  const [column, row] = [first % width, Math.floor(first / width)];
  return {
    missing,
    extra,
    at: [1000 * x_min_m + column / perMm, -1000 * y_max_m + row / perMm],
  };
}
