// The static parts: the table and the walls.

import {
  BoxGeometry,
  BufferGeometry,
  ExtrudeGeometry,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  Path,
  Shape,
  Vector2,
  type Material,
} from 'three';
import type { Palette } from '../ui/palette';
import type { MovedWalls } from '../lab/movedWalls';
import { WALL_HEIGHT_M, type Polygon, type Rect, type SceneMessage } from '../net/protocol.gen';
import { floorMargins } from '../plan/floorPicture';
import { Numbers } from './floor';
import { MovedWallMesh } from './movedWallMesh';
import type { Paints } from './paints';
import { disposeGeometries } from './solids';

/** Of the table, around the numbers of the axes: a portal's rails lie there. */
export const EDGE_M = 0.022;
const THICKNESS_M = 0.018;
/** Space for the robot's foot. */
const FOOT_M = 0.115;
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
  const { x_min_m, x_max_m, y_min_m, y_max_m } = border;
  const corners: Polygon['exterior'] = [
    [x_min_m, y_min_m],
    [x_max_m, y_min_m],
    [x_max_m, y_max_m],
    [x_min_m, y_max_m],
  ];
  for (const ring of [corners, ...walls.flatMap((wall) => [wall.exterior, ...wall.holes])]) {
    let before = ring.at(-1);
    for (const corner of ring) {
      if (before) ends.push(...before, WALL_HEIGHT_M, ...corner, WALL_HEIGHT_M);
      before = corner;
    }
  }
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(ends, 3));
}

/** The rim around the workspace: its borders are walls too. */
function rimGeometry(rect: Rect, width_m: number): ExtrudeGeometry {
  const ring = (by: number): Vector2[] => [
    new Vector2(rect.x_min_m - by, rect.y_min_m - by),
    new Vector2(rect.x_max_m + by, rect.y_min_m - by),
    new Vector2(rect.x_max_m + by, rect.y_max_m + by),
    new Vector2(rect.x_min_m - by, rect.y_max_m + by),
  ];
  const shape = new Shape(ring(width_m));
  shape.holes = [new Path(ring(0))];
  return new ExtrudeGeometry([shape], { depth: WALL_HEIGHT_M, bevelEnabled: false });
}

/** Area of the table: under floor and numbers, and under the robot's foot if there is an arm. */
export function tableOf(workspace: Rect, hasArm: boolean): Rect {
  const { left, right, bottom, top } = floorMargins(workspace);
  const side_m = Math.max(left, right) + EDGE_M;
  const rect = {
    x_min_m: workspace.x_min_m - side_m,
    x_max_m: workspace.x_max_m + side_m,
    y_min_m: workspace.y_min_m - bottom - EDGE_M,
    y_max_m: workspace.y_max_m + top + EDGE_M,
  };
  if (!hasArm) return rect;
  return {
    x_min_m: Math.min(rect.x_min_m, -FOOT_M),
    x_max_m: Math.max(rect.x_max_m, FOOT_M),
    y_min_m: Math.min(rect.y_min_m, -FOOT_M),
    y_max_m: Math.max(rect.y_max_m, FOOT_M),
  };
}

const RIM_M = 0.004;
/** Material of the sides of walls that have moved. */
const UNSEEN = new MeshBasicMaterial({ visible: false });

export class Table {
  readonly group = new Group();
  private readonly edge = new LineBasicMaterial();
  private readonly edges: BufferGeometry;
  private readonly wall: Material;
  private readonly walls: Mesh;
  private readonly numbers: Numbers;
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
    const rim = new Mesh(rimGeometry(scene.workspace, RIM_M), paints.lit('wall'));
    for (const mesh of [this.walls, rim]) {
      mesh.castShadow = true;
      mesh.receiveShadow = true;
    }
    this.group.add(slab, this.walls, rim);
    this.edges = edgeGeometry(scene.walls, scene.workspace);
    this.group.add(new LineSegments(this.edges, this.edge));
    this.numbers = new Numbers(palette, scene.workspace);
    this.group.add(this.numbers.group);
    this.edge.color.set(palette['wall-edge']);
  }

  /** Moves the walls, or puts them where they are drawn. */
  move(walls: MovedWalls | undefined): void {
    if (this.moved?.of === walls) {
      this.moved?.update();
      return;
    }
    if (this.moved) {
      this.group.remove(this.moved.group);
      this.moved.dispose();
    }
    this.moved = walls && new MovedWallMesh(this.paints, this.edge, walls);
    if (this.moved) this.group.add(this.moved.group);
    // Sides and edges at rest would flicker through the tops of moved walls.
    this.walls.material = this.moved ? [this.wall, UNSEEN] : this.wall;
    this.edges.setDrawRange(0, this.moved ? BORDER_ENDS : Infinity);
  }

  recolor(palette: Palette): void {
    this.numbers.recolor(palette);
    this.edge.color.set(palette['wall-edge']);
  }

  dispose(): void {
    disposeGeometries(this.group);
    this.numbers.dispose();
    this.edge.dispose();
  }
}
