// How large a shape is, as words, and where to write them. Pure.

import { between, distance } from '../../lab/geometry';
import type { Mm, Shape } from './drawing';

const whole = (mm: number): string => mm.toFixed(0);

function sides(values: readonly number[]): readonly [middle: number, length: number] {
  const [least, most] = [Math.min(...values), Math.max(...values)];
  return [(least + most) / 2, most - least];
}

/** The place on a line at a distance from its beginning. */
function halfway(points: readonly Mm[], steps: readonly number[], at_mm: number): Mm | undefined {
  let left_mm = at_mm;
  for (const [index, step] of steps.entries()) {
    const [from, to] = [points[index], points[index + 1]];
    if (from && to && step > 0 && left_mm <= step) {
      return between(from, to, left_mm / step);
    }
    left_mm -= step;
  }
  return points[0];
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
  const steps = points.slice(1).map((to, index) => distance(points[index] ?? to, to));
  const length_mm = steps.reduce((sum, one) => sum + one, 0);
  return { at: halfway(points, steps, length_mm / 2) ?? [x, y], text: `${whole(length_mm)} mm` };
}
