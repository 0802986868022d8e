// A map as the user draws it, in millimetres, x right and y down, as in its SVG. Pure.

import { distance, distanceToLine, insidePolygon, type Vec2 } from '../../lab/geometry';
import type { PositionerKind } from '../../net/protocol.gen';

export type Mm = Vec2;

/** A line of a chosen width, with round ends. */
export interface Wall {
  readonly kind: 'wall';
  readonly points: readonly Mm[];
  readonly width_mm: number;
}

export interface Post {
  readonly kind: 'post';
  readonly center: Mm;
  readonly radius_mm: number;
}

/** A filled outline, and its holes. */
export interface Area {
  readonly kind: 'area';
  readonly rings: readonly (readonly Mm[])[];
}

export type Shape = Wall | Post | Area;

/** The workspace. Its border is a wall. */
export interface Frame {
  readonly x_mm: number;
  readonly y_mm: number;
  readonly width_mm: number;
  readonly height_mm: number;
}

/** Places of a trial: where the bead starts, and to which goal it is to be carried. They are not in the SVG. */
export type Mark = 'start' | 'goal';

export type Marks = Readonly<Partial<Record<Mark, Mm>>>;

export interface Drawing {
  readonly frame: Frame;
  /** What moves the magnet over this map. */
  readonly positioner: PositionerKind;
  readonly shapes: readonly Shape[];
  readonly marks?: Marks;
}

/** The workspace of most shipped maps, which the arm reaches. */
export const BLANK: Drawing = {
  frame: { x_mm: -300, y_mm: 210, width_mm: 580, height_mm: 330 },
  positioner: 'arm',
  shapes: [],
};

/** What is drawn is drawn again on the other side of the frame's middle. */
export const SYMMETRIES = [
  ['none', 'off'],
  ['sides', 'left and right'],
  ['ends', 'top and bottom'],
  ['both', 'all four quarters'],
] as const;

export type Symmetry = (typeof SYMMETRIES)[number][0];

function mapped(shape: Shape, to: (point: Mm) => Mm): Shape {
  if (shape.kind === 'wall') return { ...shape, points: shape.points.map(to) };
  if (shape.kind === 'post') return { ...shape, center: to(shape.center) };
  return { ...shape, rings: shape.rings.map((ring) => ring.map(to)) };
}

export function moved(shape: Shape, [right_mm, down_mm]: Mm): Shape {
  return mapped(shape, ([x, y]) => [x + right_mm, y + down_mm]);
}

/** Exchanges the sides of the frame, or its ends. */
export const mirroredPlace =
  (frame: Frame, axis: 'sides' | 'ends') =>
  ([x, y]: Mm): Mm => {
    const sum_x = 2 * frame.x_mm + frame.width_mm;
    const sum_y = 2 * frame.y_mm + frame.height_mm;
    return axis === 'sides' ? [sum_x - x, y] : [x, sum_y - y];
  };

export function mirrored(shape: Shape, frame: Frame, axis: 'sides' | 'ends'): Shape {
  return mapped(shape, mirroredPlace(frame, axis));
}

/** Closed lines around a shape. That around a wall goes to its end and back. */
function outlinesOf(shape: Shape): readonly (readonly Mm[])[] {
  if (shape.kind === 'area') return shape.rings;
  return shape.kind === 'post'
    ? [[shape.center]]
    : [[...shape.points, ...shape.points.toReversed()]];
}

/** Text that two shapes have in common only if they cover the same: their sides, in any order and direction. */
function placeKey(shape: Shape): string {
  const sides = outlinesOf(shape).flatMap((points) =>
    points.map((point, index) => [points.at(index - 1) ?? point, point].map(place).sort().join()),
  );
  return sides.sort().join(';');
}

/** A shape with the copies that a symmetry asks for. A copy at the same place is left out. */
export function withImages(shape: Shape, frame: Frame, symmetry: Symmetry): Shape[] {
  const sides = symmetry === 'sides' || symmetry === 'both';
  const ends = symmetry === 'ends' || symmetry === 'both';
  const pair = sides ? [shape, mirrored(shape, frame, 'sides')] : [shape];
  const all = ends ? [...pair, ...pair.map((one) => mirrored(one, frame, 'ends'))] : pair;
  const keys = all.map(placeKey);
  return all.filter((_, index) => keys.indexOf(keys[index] ?? '') === index);
}

function middleOf(shape: Shape): Mm {
  const [points = []] = outlinesOf(shape);
  const middle = (axis: 0 | 1): number => {
    const values = points.map((point) => point[axis]);
    return (Math.min(...values) + Math.max(...values)) / 2;
  };
  return [middle(0), middle(1)];
}

/** A shape moved, but no farther than its middle stays in the frame: there it can be selected again. */
export function movedInside(shape: Shape, by: Mm, frame: Frame): Shape {
  const [from, to] = [middleOf(shape), middleOf(moved(shape, by))];
  const kept = clampedTo(frame, to);
  return moved(shape, [kept[0] - from[0], kept[1] - from[1]]);
}

export function clampedTo(frame: Frame, [x, y]: Mm): Mm {
  return [
    Math.min(frame.x_mm + frame.width_mm, Math.max(frame.x_mm, x)),
    Math.min(frame.y_mm + frame.height_mm, Math.max(frame.y_mm, y)),
  ];
}

/** The nearest point of the grid; the point itself if the spacing is 0. */
export function snapped([x, y]: Mm, spacing_mm: number): Mm {
  if (spacing_mm === 0) return [x, y];
  return [Math.round(x / spacing_mm) * spacing_mm, Math.round(y / spacing_mm) * spacing_mm];
}

function isAt(shape: Shape, at: Mm, slop_mm: number): boolean {
  if (shape.kind === 'post') return distance(at, shape.center) <= shape.radius_mm + slop_mm;
  if (shape.kind === 'wall') {
    const most_mm = shape.width_mm / 2 + slop_mm;
    return shape.points.some(
      (point, index) => distanceToLine(at, shape.points[index - 1] ?? point, point) <= most_mm,
    );
  }
  const [exterior = [], ...holes] = shape.rings;
  return insidePolygon({ exterior, holes }, at);
}

/** The index of the topmost shape at a point, or within `slop_mm` of a line or post there. */
export function shapeAt(drawing: Drawing, at: Mm, slop_mm: number): number | undefined {
  const index = drawing.shapes.findLastIndex((shape) => isAt(shape, at, slop_mm));
  return index < 0 ? undefined : index;
}

/** Without needless digits: a hundredth of a millimetre. */
const number = (value: number): string => String(Number(value.toFixed(2)));

const place = ([x, y]: Mm): string => `${number(x)} ${number(y)}`;

const ringText = (ring: readonly Mm[]): string => `M${ring.map(place).join('L')}Z`;

/** The `d` of a path that shows a shape: the middle line of a wall, the outline of others. */
export function pathText(shape: Shape): string {
  if (shape.kind === 'wall') {
    // A line of one point is drawn as a dot only if it has an end.
    const [first] = shape.points;
    const points = shape.points.length === 1 && first ? [first, first] : shape.points;
    return `M${points.map(place).join('L')}`;
  }
  if (shape.kind === 'area') return shape.rings.map(ringText).join('');
  const { center, radius_mm } = shape;
  const [r, left] = [number(radius_mm), place([center[0] - radius_mm, center[1]])];
  const right = place([center[0] + radius_mm, center[1]]);
  return `M${left}A${r} ${r} 0 1 0 ${right}A${r} ${r} 0 1 0 ${left}Z`;
}

function elementText(shape: Shape): string {
  if (shape.kind === 'wall') {
    return `<path d="${pathText(shape)}" stroke-width="${number(shape.width_mm)}" class="wall"/>`;
  }
  if (shape.kind === 'area') return `<path d="${pathText(shape)}" fill-rule="evenodd"/>`;
  const { center, radius_mm } = shape;
  return `<circle cx="${number(center[0])}" cy="${number(center[1])}" r="${number(radius_mm)}"/>`;
}

/** The drawing as a map for the server, and for other drawing programs. */
export function svgText({ frame, positioner, shapes }: Drawing): string {
  const { x_mm, y_mm, width_mm, height_mm } = frame;
  const size = `width="${number(width_mm)}mm" height="${number(height_mm)}mm"`;
  const stage = positioner === 'planar_stage' ? ' data-positioner="planar-stage"' : '';
  const viewBox = [x_mm, y_mm, width_mm, height_mm].map(number).join(' ');
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" ${size} viewBox="${viewBox}"${stage}>`,
    '<style>.wall{fill:none;stroke:#404048;stroke-linecap:round;stroke-linejoin:round}</style>',
    '<g fill="#404048">',
    ...shapes.map(elementText),
    '</g>',
    '</svg>',
    '',
  ].join('\n');
}
