// What tools do with a drawing: one step for each click, drag and key. Pure.

import { distance } from '../../lab/geometry';
import { carved, simplified } from './carve';
import {
  clampedTo,
  type Drawing,
  type Mark,
  mirrored,
  mirroredPlace,
  type Mm,
  movedInside,
  type Shape,
  shapeAt,
  snapped,
  type Symmetry,
  type Wall,
  withImages,
} from './drawing';

export type Tool = 'wall' | 'post' | 'area' | 'erase' | 'move' | Mark;
/** Tools with a size: width of a wall, diameter of a post, width of the eraser. */
export type Brush = 'wall' | 'post' | 'erase';

export interface Settings {
  readonly size_mm: Readonly<Record<Brush, number>>;
  /** Spacing of the points to which corners and posts go; 0 for none. */
  readonly snap_mm: number;
  readonly symmetry: Symmetry;
}

export interface Editing extends Settings {
  readonly drawing: Drawing;
  readonly tool: Tool;
  /** Corners of a wall or an area that is not finished. */
  readonly corners: readonly Mm[];
  /** The places of a drag so far. */
  readonly trace: readonly Mm[];
  /** Index of the selected shape. */
  readonly selected: number | undefined;
}

export type Step =
  | { readonly type: 'click'; readonly at: Mm; readonly slop_mm: number }
  | { readonly type: 'drag'; readonly at: Mm; readonly slop_mm: number }
  | { readonly type: 'drop' }
  /** Ends a begun wall or area. */
  | { readonly type: 'finish' }
  /** Drops the last corner. */
  | { readonly type: 'back' }
  /** Drops what is begun, or else the selection. */
  | { readonly type: 'cancel' }
  | { readonly type: 'delete' }
  | { readonly type: 'nudge'; readonly by: Mm }
  | { readonly type: 'mirror'; readonly axis: 'sides' | 'ends' }
  | { readonly type: 'tool'; readonly tool: Tool }
  | { readonly type: 'set'; readonly settings: Partial<Settings> }
  /** Another drawing, or an earlier or later state of this one. */
  | { readonly type: 'show'; readonly drawing: Drawing };

export const SIZES_MM = { least: 4, most: 80 } as const;
/** Points of a line drawn by hand stay this near to it. */
const SMOOTH_MM = 1;
/** An area with less than this is a slip of the hand. */
const LEAST_SIDE_MM = 2;

export function begin(drawing: Drawing): Editing {
  return {
    drawing,
    tool: 'wall',
    size_mm: { wall: 12, post: 30, erase: 40 },
    snap_mm: 5,
    symmetry: 'none',
    corners: [],
    trace: [],
    selected: undefined,
  };
}

const IDLE = { corners: [], trace: [] } as const;

function withShapes(editing: Editing, shapes: readonly Shape[]): Editing {
  return { ...editing, ...IDLE, drawing: { ...editing.drawing, shapes } };
}

function added(editing: Editing, shape: Shape): Editing {
  const { frame, shapes } = editing.drawing;
  return withShapes(editing, [...shapes, ...withImages(shape, frame, editing.symmetry)]);
}

function marked(editing: Editing, mark: Mark, at: Mm | undefined): Editing {
  const { [mark]: before, ...others } = editing.drawing.marks ?? {};
  if (!before && !at) return editing;
  const marks = at ? { ...others, [mark]: at } : others;
  return { ...editing, ...IDLE, drawing: { ...editing.drawing, marks } };
}

const wallOf = ({ size_mm }: Editing, points: readonly Mm[]): Wall => ({
  kind: 'wall',
  points,
  width_mm: size_mm.wall,
});

function erased(editing: Editing, points: readonly Mm[]): Editing {
  const { frame, shapes } = editing.drawing;
  const line: Wall = { kind: 'wall', points: simplified(points, SMOOTH_MM), width_mm: 0 };
  const images = withImages(line, frame, editing.symmetry);
  const lines = images.flatMap((image) => (image.kind === 'wall' ? [image.points] : []));
  const left = carved(shapes, lines, editing.size_mm.erase);
  if (left.length === shapes.length && left.every((shape, index) => shape === shapes[index])) {
    return { ...editing, ...IDLE };
  }
  // A shape that was cut has another index, or is several.
  return { ...withShapes(editing, left), selected: undefined };
}

/** The corners of the rectangle between two opposite ones. */
function rectangle([left, top]: Mm, [right, bottom]: Mm): Mm[] {
  return [
    [left, top],
    [right, top],
    [right, bottom],
    [left, bottom],
  ];
}

/** The shape that is being drawn, if it is large enough to be one. */
export function pending(editing: Editing, pointer?: Mm): Shape | undefined {
  const { tool, corners, trace, size_mm, snap_mm } = editing;
  const [from, to] = [trace[0], trace.at(-1)];
  const next = pointer && snapped(pointer, snap_mm);
  if (tool === 'wall') {
    if (trace.length > 0) return wallOf(editing, trace);
    return corners.length > 0 ? wallOf(editing, next ? [...corners, next] : corners) : undefined;
  }
  if (tool === 'area') {
    if (from && to) {
      const ring = rectangle(snapped(from, snap_mm), snapped(to, snap_mm));
      return { kind: 'area', rings: [ring] };
    }
    const ring = next && corners.length > 0 ? [...corners, next] : corners;
    return ring.length > 0 ? { kind: 'area', rings: [ring] } : undefined;
  }
  if (tool === 'post' && from && to) {
    // A drag from the middle of a post gives its size.
    const radius_mm = Math.max(distance(from, to), SIZES_MM.least / 2);
    return { kind: 'post', center: snapped(from, snap_mm), radius_mm };
  }
  if (tool === 'erase' && trace.length > 0) {
    return { kind: 'wall', points: trace, width_mm: size_mm.erase };
  }
  return undefined;
}

/** By how much the selected shape is being moved. */
export function shift({ tool, trace, snap_mm }: Editing): Mm | undefined {
  const [from, to] = [trace[0], trace.at(-1)];
  if (tool !== 'move' || !from || !to) return undefined;
  return snapped([to[0] - from[0], to[1] - from[1]], snap_mm);
}

function isTooSmall(ring: readonly Mm[]): boolean {
  const [xs, ys] = [ring.map(([x]) => x), ring.map(([, y]) => y)];
  const side = (values: number[]): number => Math.max(...values) - Math.min(...values);
  return ring.length < 3 || side(xs) < LEAST_SIDE_MM || side(ys) < LEAST_SIDE_MM;
}

function finished(editing: Editing): Editing {
  const { tool, corners } = editing;
  if (tool === 'wall' && corners.length > 0) return added(editing, wallOf(editing, corners));
  if (tool === 'area' && !isTooSmall(corners)) {
    return added(editing, { kind: 'area', rings: [corners] });
  }
  return { ...editing, ...IDLE };
}

function clicked(editing: Editing, pointer: Mm, slop_mm: number): Editing {
  const { tool, corners, size_mm, snap_mm, drawing } = editing;
  const at = snapped(clampedTo(drawing.frame, pointer), snap_mm);
  const isNear = (corner: Mm | undefined): boolean =>
    corner !== undefined && distance(corner, at) <= slop_mm;
  switch (tool) {
    case 'wall':
      return isNear(corners.at(-1)) ? finished(editing) : { ...editing, corners: [...corners, at] };
    case 'area':
      return corners.length > 2 && (isNear(corners[0]) || isNear(corners.at(-1)))
        ? finished(editing)
        : { ...editing, corners: isNear(corners.at(-1)) ? corners : [...corners, at] };
    case 'post':
      return added(editing, { kind: 'post', center: at, radius_mm: size_mm.post / 2 });
    case 'erase':
      return erased(editing, [pointer]);
    case 'move':
      return { ...editing, selected: shapeAt(drawing, pointer, slop_mm) };
    case 'start':
    case 'goal':
      return marked(editing, tool, isNear(drawing.marks?.[tool]) ? undefined : at);
  }
}

/** A drag of the move tool begins on a shape; otherwise there is nothing to drag. */
function dragged(editing: Editing, pointer: Mm, slop_mm: number): Editing {
  const { tool, trace, drawing } = editing;
  const at = clampedTo(drawing.frame, pointer);
  if (trace.length > 0) return { ...editing, trace: [...trace, at] };
  const begun = tool === 'wall' || tool === 'area' ? finished(editing) : editing;
  const selected = tool === 'move' ? shapeAt(drawing, pointer, slop_mm) : editing.selected;
  if (tool === 'move' && selected === undefined) return { ...editing, selected };
  return { ...begun, selected, trace: [at] };
}

function replaced(editing: Editing, change: (shape: Shape) => Shape): Editing {
  const { selected, drawing } = editing;
  const shapes = drawing.shapes.map((shape, index) => (index === selected ? change(shape) : shape));
  return { ...withShapes(editing, shapes), selected };
}

function dropped(editing: Editing): Editing {
  const { tool, trace } = editing;
  if (trace.length === 0) return editing;
  const by = shift(editing);
  if (by)
    return by[0] === 0 && by[1] === 0
      ? { ...editing, ...IDLE }
      : replaced(editing, (shape) => movedInside(shape, by, editing.drawing.frame));
  if (tool === 'erase') return erased(editing, trace);
  const last = trace.at(-1);
  if (last && (tool === 'start' || tool === 'goal'))
    return marked(editing, tool, snapped(last, editing.snap_mm));
  if (tool === 'wall') return added(editing, wallOf(editing, simplified(trace, SMOOTH_MM)));
  const shape = pending(editing);
  const isSlip = shape?.kind === 'area' && isTooSmall(shape.rings[0] ?? []);
  return shape && !isSlip ? added(editing, shape) : { ...editing, ...IDLE };
}

export function after(editing: Editing, step: Step): Editing {
  const { drawing, selected, corners, trace } = editing;
  switch (step.type) {
    case 'click':
      return clicked(editing, step.at, step.slop_mm);
    case 'drag':
      return dragged(editing, step.at, step.slop_mm);
    case 'drop':
      return dropped(editing);
    case 'finish':
      // Two corners are not an area yet.
      return editing.tool === 'area' && isTooSmall(corners) ? editing : finished(editing);
    case 'back':
      return { ...editing, corners: corners.slice(0, -1) };
    case 'cancel':
      return corners.length + trace.length > 0
        ? { ...editing, ...IDLE }
        : { ...editing, selected: undefined };
    case 'delete':
      if (selected === undefined) return editing;
      return {
        ...withShapes(editing, drawing.shapes.toSpliced(selected, 1)),
        selected: undefined,
      };
    case 'nudge':
      return selected === undefined
        ? editing
        : replaced(editing, (shape) => movedInside(shape, step.by, drawing.frame));
    case 'mirror': {
      const whole = finished(editing);
      const mirror = (shape: Shape): Shape => mirrored(shape, drawing.frame, step.axis);
      if (selected !== undefined) return replaced(whole, mirror);
      const place = mirroredPlace(drawing.frame, step.axis);
      const marks = Object.entries(whole.drawing.marks ?? {}) as [Mark, Mm][];
      return marks.reduce(
        (now, [mark, at]) => marked(now, mark, place(at)),
        withShapes(whole, whole.drawing.shapes.map(mirror)),
      );
    }
    case 'tool':
      return { ...finished(editing), tool: step.tool, selected: undefined };
    case 'set':
      return { ...editing, ...step.settings };
    case 'show':
      return { ...editing, ...IDLE, drawing: step.drawing, selected: undefined };
  }
}
