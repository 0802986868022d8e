// The eraser, and the smoothing of lines drawn by hand. Pure.

import {
  ClipType,
  Clipper,
  EndType,
  FillRule,
  JoinType,
  PolyTreeD,
  type PathD,
  type PathsD,
  type PolyPathD,
} from 'clipper2-ts';
import type { Area, Mm, Shape, Wall } from './drawing';

/** Decimal places of millimetres. */
const DECIMALS = 2;
/** Largest distance between an arc and the chords that replace it. */
const ARC_MM = 0.05;
const MITER = 2;
/** Pieces with less than this are crumbs. */
const LEAST_MM2 = 1;

const pathOf = (points: readonly Mm[]): PathD => points.map(([x, y]) => ({ x, y }));

function outline(shape: Shape): PathsD {
  if (shape.kind === 'area') return shape.rings.map(pathOf);
  const [points, width_mm] =
    shape.kind === 'wall' ? [shape.points, shape.width_mm] : [[shape.center], 2 * shape.radius_mm];
  return Clipper.inflatePathsD(
    [pathOf(points)],
    width_mm / 2,
    JoinType.Round,
    EndType.Round,
    MITER,
    DECIMALS,
    ARC_MM,
  );
}

/** The outer rings of a tree, each with its holes. */
function areasOf(tree: PolyPathD): Area[] {
  const children = Array.from({ length: tree.count }, (_, index) => tree.child(index));
  return children.flatMap((outer) => {
    const holes = Array.from({ length: outer.count }, (_, index) => outer.child(index));
    const rings = [outer, ...holes].flatMap(({ poly }) => (poly ? [poly] : []));
    const area_mm2 = rings.reduce((sum, ring) => sum + Clipper.areaD(ring), 0);
    const inside = holes.flatMap(areasOf);
    if (Math.abs(area_mm2) < LEAST_MM2) return inside;
    const points = rings.map((ring) => ring.map(({ x, y }): Mm => [x, y]));
    return [{ kind: 'area', rings: points }, ...inside];
  });
}

function areaMm2(paths: PathsD): number {
  return Math.abs(Clipper.areaPathsD(paths));
}

/** The shapes without what is under the eraser. A shape that it does not touch stays as it is. */
export function carved(shapes: readonly Shape[], eraser: Wall): Shape[] {
  const rubber = outline(eraser);
  return shapes.flatMap((shape): Shape[] => {
    const before = outline(shape);
    const common = Clipper.intersectD(before, rubber, FillRule.EvenOdd, DECIMALS);
    if (areaMm2(common) === 0) return [shape];
    const tree = new PolyTreeD();
    Clipper.booleanOpDWithPolyTree(
      ClipType.Difference,
      before,
      rubber,
      tree,
      FillRule.EvenOdd,
      DECIMALS,
    );
    return areasOf(tree);
  });
}

/** A line drawn by hand with as few points as stay within `most_mm` of it. */
export function simplified(points: readonly Mm[], most_mm: number): Mm[] {
  return Clipper.ramerDouglasPeuckerD(pathOf(points), most_mm).map(({ x, y }): Mm => [x, y]);
}
