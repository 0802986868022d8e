// The drawing in the browser's storage, so that a reload does not lose it.

import type { Drawing, Frame, Marks, Mm, Shape } from './drawing';

const isNumber = (value: unknown): value is number => Number.isFinite(value);

const isPlace = (value: unknown): value is Mm =>
  Array.isArray(value) && value.length === 2 && value.every(isNumber);

const isLine = (value: unknown): value is Mm[] =>
  Array.isArray(value) && value.length > 0 && value.every(isPlace);

function isShape(value: unknown): value is Shape {
  const { kind, points, width_mm, center, radius_mm, rings } = value as Record<string, unknown>;
  if (kind === 'wall') return isLine(points) && isNumber(width_mm);
  if (kind === 'post') return isPlace(center) && isNumber(radius_mm);
  return kind === 'area' && Array.isArray(rings) && rings.length > 0 && rings.every(isLine);
}

function isFrame(value: unknown): value is Frame {
  const { x_mm, y_mm, width_mm, height_mm } = value as Record<string, unknown>;
  return [x_mm, y_mm, width_mm, height_mm].every(isNumber);
}

/** The marks that are whole. */
function marksFrom(value: unknown): Marks {
  const { start, goal } = Object(value) as Record<string, unknown>;
  return { ...(isPlace(start) && { start }), ...(isPlace(goal) && { goal }) };
}

/** The stored drawing; undefined if it is missing or damaged. */
export function draftFrom(text: string | null): Drawing | undefined {
  try {
    const { frame, positioner, shapes, marks } = JSON.parse(text ?? '') as Record<string, unknown>;
    const isWhole =
      isFrame(frame) &&
      (positioner === 'arm' || positioner === 'planar_stage') &&
      Array.isArray(shapes) &&
      shapes.every(isShape);
    if (!isWhole) return undefined;
    return { frame, positioner, shapes, ...(marks !== undefined && { marks: marksFrom(marks) }) };
  } catch {
    return undefined;
  }
}
