// The static parts: the table and the walls.

import {
  BoxGeometry,
  BufferGeometry,
  ExtrudeGeometry,
  Float32BufferAttribute,
  Group,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  Path,
  Shape,
  Vector2,
  type Material,
} from 'three';
import type { MovedWalls } from '../lab/movedWalls';
import { WALL_HEIGHT_M, type Polygon, type Rect, type SceneMessage } from '../net/protocol.gen';
import { around, cornersOf } from '../lab/geometry';
import { floorMargins } from '../plan/floorPicture';
import { grown } from '../plan/transform';
import { axisNumbers } from './floor';
import { MovedWallMesh } from './movedWallMesh';
import type { Paints } from './paints';
import { dispose } from './solids';
import type { Palette } from '../ui/palette';

/** Of the table, around the numbers of the axes: a portal's rails lie there. */
export const EDGE_M = 0.022;
const THICKNESS_M = 0.018;
/** Space for the robot's foot. */
const FOOT: Rect = { x_min_m: -0.115, x_max_m: 0.115, y_min_m: -0.115, y_max_m: 0.115 };
const RIM_M = 0.004;
/** Height of the floor over the table, so that the two do not flicker. */
const GAP_M = 4e-4;

const points = (ring: Polygon['exterior']): Vector2[] => ring.map(([x, y]) => new Vector2(x, y));

function wallGeometry(walls: readonly Polygon[]): ExtrudeGeometry {
  const shapes = walls.map((wall) => {
    const shape = new Shape(points(wall.exterior));
    shape.holes = wall.holes.map((hole) => new Path(points(hole)));
    return shape;
  });
  return new ExtrudeGeometry(shapes, { depth: WALL_HEIGHT_M, bevelEnabled: false });
}

/** Ends of the border's lines. */
const BORDER_ENDS = 8;

/** The upper edges of border and walls, which make their shape visible from a distance. */
function edgeGeometry(walls: readonly Polygon[], border: Rect): BufferGeometry {
  const ends: number[] = [];
  for (const ring of [
    cornersOf(border),
    ...walls.flatMap((wall) => [wall.exterior, ...wall.holes]),
  ]) {
    let before = ring.at(-1);
    for (const corner of ring) {
      if (before) ends.push(...before, WALL_HEIGHT_M, ...corner, WALL_HEIGHT_M);
      before = corner;
    }
  }
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(ends, 3));
}

/** The rim around the workspace: its borders are walls too. */
const rimOf = (workspace: Rect): Polygon => ({
  exterior: cornersOf(grown(workspace, { left: RIM_M, right: RIM_M, top: RIM_M, bottom: RIM_M })),
  holes: [cornersOf(workspace)],
});

/** Area of the table: under floor and numbers, and under the robot's foot if there is an arm. */
export function tableOf(workspace: Rect, hasArm: boolean): Rect {
  const { left, right, bottom, top } = floorMargins(workspace);
  const side = Math.max(left, right) + EDGE_M;
  const insets = { left: side, right: side, bottom: bottom + EDGE_M, top: top + EDGE_M };
  const table = grown(workspace, insets);
  return hasArm ? around(table, FOOT) : table;
}

/** Material of the sides of walls that have moved. */
const UNSEEN = new MeshBasicMaterial({ visible: false });

export class Table {
  readonly group = new Group();
  private readonly edges: BufferGeometry;
  private readonly wall: Material;
  private readonly walls: Mesh;
  private moved: MovedWallMesh | undefined;

  constructor(
    private readonly paints: Paints,
    palette: Palette,
    scene: SceneMessage,
  ) {
    const table = tableOf(scene.workspace, scene.positioner === 'arm');
    const size = [table.x_max_m - table.x_min_m, table.y_max_m - table.y_min_m] as const;
    const slab = new Mesh(new BoxGeometry(...size, THICKNESS_M), paints.lit('table'));
    slab.position.set(
      (table.x_min_m + table.x_max_m) / 2,
      (table.y_min_m + table.y_max_m) / 2,
      -THICKNESS_M / 2 - GAP_M,
    );
    slab.receiveShadow = true;

    this.wall = paints.lit('wall');
    this.walls = new Mesh(wallGeometry(scene.walls), this.wall);
    const rim = new Mesh(wallGeometry([rimOf(scene.workspace)]), this.wall);
    for (const mesh of [this.walls, rim]) {
      mesh.castShadow = true;
      mesh.receiveShadow = true;
    }
    this.edges = edgeGeometry(scene.walls, scene.workspace);
    const edges = new LineSegments(this.edges, paints.edge('wall-rim'));
    this.group.add(slab, this.walls, rim, edges, axisNumbers(palette, scene.workspace));
  }

  /** Moves the walls, or puts them where they are drawn. */
  move(walls: MovedWalls | undefined): void {
    if (this.moved?.of === walls) {
      this.moved?.update();
      return;
    }
    if (this.moved) {
      this.group.remove(this.moved.group);
      dispose(this.moved.group);
    }
    this.moved = walls && new MovedWallMesh(this.paints, walls);
    if (this.moved) this.group.add(this.moved.group);
    // Sides and edges at rest would flicker through the tops of moved walls.
    this.walls.material = this.moved ? [this.wall, UNSEEN] : this.wall;
    this.edges.setDrawRange(0, this.moved ? BORDER_ENDS : Infinity);
  }
}
