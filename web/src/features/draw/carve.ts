// The eraser, and the smoothing of lines drawn by hand. Pure.

import simplify from 'simplify-js';

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
import type { Area, Mm, Shape } from './drawing';

/** Decimal places of millimetres. */
const DECIMALS = 2;
/** Largest distance between an arc and the chords that replace it. */
const ARC_MM = 0.05;
const MITER = 2;
/** Pieces with less than this are crumbs. */
const LEAST_MM2 = 1;

const pathOf = (points: readonly Mm[]): PathD => points.map(([x, y]) => ({ x, y }));

/** The outlines of walls of one width together. */
function outlineOf(walls: readonly (readonly Mm[])[], width_mm: number): PathsD {
  return Clipper.inflatePathsD(
    walls.map(pathOf),
    width_mm / 2,
    JoinType.Round,
    EndType.Round,
    MITER,
    DECIMALS,
    ARC_MM,
  );
}

function outline(shape: Shape): PathsD {
  if (shape.kind === 'area') return shape.rings.map(pathOf);
  if (shape.kind === 'wall') return outlineOf([shape.points], shape.width_mm);
  return outlineOf([[shape.center]], 2 * shape.radius_mm);
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

const areaMm2 = (paths: PathsD): number => Math.abs(Clipper.areaPathsD(paths));

/**
 * The shapes without what is under the eraser, which went along several lines. A shape that it does not touch stays as it
 * is.
 */
export function carved(
  shapes: readonly Shape[],
  lines: readonly (readonly Mm[])[],
  width_mm: number,
): Shape[] {
  const rubber = outlineOf(lines, width_mm);
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
  const all = points.map(([x, y]) => ({ x, y }));
  return simplify(all, most_mm, true).map(({ x, y }): Mm => [x, y]);
}
