// Solids from tubes and boxes: one mesh per colour, because every mesh costs a draw call.

import {
  BoxGeometry,
  BufferGeometry,
  CylinderGeometry,
  Float32BufferAttribute,
  Group,
  LatheGeometry,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  Vector2,
  Vector3,
  type Object3D,
} from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { ORDER, type PaintName, type Paints } from './paints';

const ROUND = 40;
/** Rows of a lid's dome. */
const DOME = 6;

export type Point = readonly [number, number, number];

/** Axis of round solids. A place on it is a distance from `origin`. */
export interface Line {
  readonly origin: Point;
  /** Unit vector. */
  readonly along: Point;
}

const vector = ([x, y, z]: Point): Vector3 => new Vector3(x, y, z);

/** Puts the origin at a place on the line and y, the axis of three's round solids, toward another. */
function onLine({ origin, along }: Line, from_m: number, to_m: number): Matrix4 {
  const toward = vector(along).multiplyScalar(Math.sign(to_m - from_m));
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), toward);
  const at = vector(origin).addScaledVector(vector(along), from_m);
  return new Matrix4().compose(at, turn, new Vector3(1, 1, 1));
}

export class Solids {
  private readonly pieces = new Map<PaintName, BufferGeometry[]>();

  /** A cylinder between two places on a line, or a cone with a second radius. */
  tube(
    name: PaintName,
    line: Line,
    [from_m, to_m]: readonly [number, number],
    radius_m: number,
    endRadius_m = radius_m,
  ): this {
    const length_m = Math.abs(to_m - from_m);
    const geometry = new CylinderGeometry(endRadius_m, radius_m, length_m, ROUND);
    return this.add(name, geometry.translate(0, length_m / 2, 0), onLine(line, from_m, to_m));
  }

  /** A lid from its rim at the first place to its domed top at the second: half of the ball r⁴ + z⁴ = 1. */
  lid(
    name: PaintName,
    line: Line,
    [rim_m, top_m]: readonly [number, number],
    radius_m: number,
  ): this {
    const length_m = Math.abs(top_m - rim_m);
    const profile = Array.from({ length: DOME + 1 }, (_, i) => {
      const angle = (Math.PI / 2) * (i / DOME);
      const across = Math.sqrt(Math.max(0, Math.cos(angle)));
      return new Vector2(radius_m * across, length_m * Math.sqrt(Math.sin(angle)));
    });
    return this.add(name, new LatheGeometry(profile, ROUND), onLine(line, rim_m, top_m));
  }

  box(name: PaintName, center: Point, size: Point): this {
    return this.add(name, new BoxGeometry(...size), new Matrix4().setPosition(vector(center)));
  }

  private add(name: PaintName, geometry: BufferGeometry, at: Matrix4): this {
    geometry.applyMatrix4(at);
    const pieces = this.pieces.get(name);
    if (pieces) pieces.push(geometry);
    else this.pieces.set(name, [geometry]);
    return this;
  }

  /** The parts of one `set` have one opacity. */
  group(paints: Paints, set?: string): Group {
    const group = new Group();
    group.renderOrder = ORDER.solids;
    for (const [name, pieces] of this.pieces) {
      const mesh = new Mesh(mergeGeometries(pieces), paints.over(name, set));
      for (const piece of pieces) piece.dispose();
      mesh.castShadow = true;
      mesh.receiveShadow = true;
      group.add(mesh);
    }
    return group;
  }
}

/** Frees the graphics memory of `object` and its children. The materials of `Paints` stay. */
export function dispose(object: Object3D): void {
  object.traverse((one) => {
    if (!('geometry' in one)) return;
    const { geometry, material } = one as Mesh;
    geometry.dispose();
    for (const own of [material].flat()) {
      if (own.userData.isShared) continue;
      if (own instanceof MeshBasicMaterial) own.map?.dispose();
      own.dispose();
    }
  });
}

/** Three corners per triangle. */
export function triangles(corners: readonly Point[]): BufferGeometry {
  return new BufferGeometry().setAttribute(
    'position',
    new Float32BufferAttribute(corners.flat(), 3),
  );
}
