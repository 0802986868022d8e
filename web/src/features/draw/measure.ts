// How large a shape is, as words, and where to write them. Pure.

import { distance } from '../../lab/geometry';
import type { Mm, Shape } from './drawing';

const whole = (mm: number): string => mm.toFixed(0);

function sides(values: readonly number[]): readonly [middle: number, length: number] {
  const [least, most] = [Math.min(...values), Math.max(...values)];
  return [(least + most) / 2, most - least];
}

export function measured(shape: Shape): { readonly at: Mm; readonly text: string } {
  if (shape.kind === 'post') {
    return { at: shape.center, text: `⌀ ${whole(2 * shape.radius_mm)} mm` };
  }
  const points = shape.kind === 'wall' ? shape.points : shape.rings.flat();
  const [x, width_mm] = sides(points.map(([right]) => right));
  const [y, height_mm] = sides(points.map(([, down]) => down));
  if (shape.kind === 'area') {
    return { at: [x, y], text: `${whole(width_mm)} × ${whole(height_mm)} mm` };
  }
  const length_mm = points.reduce(
    (sum, to, index) => sum + distance(points[Math.max(0, index - 1)] ?? to, to),
    0,
  );
  return { at: [x, y], text: `${whole(length_mm)} mm` };
}
