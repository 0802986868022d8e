// The body of the tray: walls and rim in one piece, with a rounded upper edge.

import { ClipType, Clipper, EndType, FillRule, JoinType, PolyTreeD } from 'clipper2-ts';
import type { PathD, PathsD, PolyPathD } from 'clipper2-ts';
import { BufferGeometry, Float32BufferAttribute, ShapeUtils, Vector2 } from 'three';
import type { Polygon } from '../net/protocol.gen';
import { BEVEL_M, TRAY_UP_M } from './tray';

/** Decimal places of metres. */
const DECIMALS = 5;
const MITER = 2;
const ARC_M = 1e-4;
/** Of the normals at the lower end of the rounded edge. */
const LEAN = 0.7;
/** Cosine of the largest turn of an outline that is smooth. */
const SMOOTH = 0.75;

const pathOf = (ring: Polygon['exterior']): PathD => ring.map(([x, y]) => ({ x, y }));
const keyOf = ({ x, y }: { x: number; y: number }): string =>
  `${x.toFixed(DECIMALS)} ${y.toFixed(DECIMALS)}`;

/** The outlines of some polygons together, which may overlap: the solid lies on their left. */
export function joined(polygons: readonly Polygon[]): PathsD {
  const each = polygons.flatMap(({ exterior, holes }) =>
    Clipper.unionD([exterior, ...holes].map(pathOf), [], FillRule.EvenOdd, DECIMALS),
  );
  return Clipper.unionD(each, [], FillRule.NonZero, DECIMALS);
}

/** Outer rings, each with its holes. */
function partsOf(tree: PolyPathD): { outer: PathD; holes: PathD[] }[] {
  const children = (of: PolyPathD): PolyPathD[] =>
    Array.from({ length: of.count }, (_, i) => of.child(i));
  return children(tree).flatMap((one) => {
    const holes = children(one);
    const part = { outer: one.poly ?? [], holes: holes.map(({ poly }) => poly ?? []) };
    return [part, ...holes.flatMap(partsOf)];
  });
}

interface Corner {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Its normal leans by this much of x and y, and the rest upward. */
  readonly nx: number;
  readonly ny: number;
}

class Faces {
  readonly positions: number[] = [];
  readonly normals: number[] = [];

  add({ x, y, z, nx, ny }: Corner): void {
    this.positions.push(x, y, z);
    this.normals.push(nx, ny, Math.sqrt(Math.max(0, 1 - nx * nx - ny * ny)));
  }

  /** The area of `paths` without `without`, with corners at the heights that `cornerOf` tells. */
  fill(paths: PathsD, without: PathsD, cornerOf: (at: { x: number; y: number }) => Corner): void {
    const tree = new PolyTreeD();
    const { Difference } = ClipType;
    Clipper.booleanOpDWithPolyTree(Difference, paths, without, tree, FillRule.NonZero, DECIMALS);
    for (const { outer, holes } of partsOf(tree)) {
      const rings = [outer, ...holes].map((ring) => ring.map(({ x, y }) => new Vector2(x, y)));
      const [contour = [], ...inner] = rings;
      const corners = rings.flat().map(cornerOf);
      for (const face of ShapeUtils.triangulateShape(contour, inner)) {
        for (const i of face) {
          const corner = corners[i];
          if (corner) this.add(corner);
        }
      }
    }
  }
}

/** The outward normals of an outline: of each edge, and of each corner. */
function normalsOf(path: PathD): { edges: Vector2[]; corners: Vector2[] } {
  const edges = path.map(({ x, y }, i) => {
    const next = path[(i + 1) % path.length] ?? { x, y };
    return new Vector2(next.y - y, x - next.x).normalize();
  });
  const corners = edges.map((edge, i) =>
    edge
      .clone()
      .add(edges.at(i - 1) ?? edge)
      .normalize(),
  );
  return { edges, corners };
}

/** Upright sides, and an upper edge that is rounded inside of the outlines. The sides are the second group. */
export function solidOf(paths: PathsD): BufferGeometry {
  const { Round } = JoinType;
  const { Polygon } = EndType;
  const lid = Clipper.inflatePathsD(paths, -BEVEL_M, Round, Polygon, MITER, DECIMALS, ARC_M);
  const faces = new Faces();
  const top = ({ x, y }: { x: number; y: number }): Corner => ({
    x,
    y,
    z: TRAY_UP_M,
    nx: 0,
    ny: 0,
  });
  faces.fill(lid, [], top);

  const edge = new Map<string, Corner>();
  const outlines = paths.map((path) => ({ path, ...normalsOf(path) }));
  const z = TRAY_UP_M - BEVEL_M;
  for (const { path, corners } of outlines) {
    path.forEach(({ x, y }, i) => {
      const { x: nx, y: ny } = corners[i] ?? { x: 0, y: 0 };
      edge.set(keyOf({ x, y }), { x, y, z, nx: LEAN * nx, ny: LEAN * ny });
    });
  }
  faces.fill(paths, lid, (at) => edge.get(keyOf(at)) ?? top(at));

  const above = faces.positions.length / 3;
  for (const { path, edges, corners } of outlines) {
    path.forEach((from, i) => {
      const next = (i + 1) % path.length;
      const to = path[next];
      const flat = edges[i];
      if (!to || !flat) return;
      const cornerAt = (
        at: { x: number; y: number },
        smooth: Vector2 | undefined,
        height: number,
      ): Corner => {
        const { x: nx, y: ny } = smooth && smooth.dot(flat) > SMOOTH ? smooth : flat;
        return { x: at.x, y: at.y, z: height, nx, ny };
      };
      const [a, b, c, d] = [
        cornerAt(from, corners[i], 0),
        cornerAt(to, corners[next], 0),
        cornerAt(to, corners[next], z),
        cornerAt(from, corners[i], z),
      ] as const;
      for (const corner of [a, b, c, a, c, d]) faces.add(corner);
    });
  }
  const solid = new BufferGeometry();
  solid.setAttribute('position', new Float32BufferAttribute(faces.positions, 3));
  solid.setAttribute('normal', new Float32BufferAttribute(faces.normals, 3));
  solid.addGroup(0, above, 0);
  solid.addGroup(above, faces.positions.length / 3 - above, 1);
  return solid;
}
