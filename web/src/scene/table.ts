// The static parts: the tray with its walls, and the shadows on the table, which has no edge.

import { Group, Mesh, MeshBasicMaterial, PlaneGeometry, type Material } from 'three';
import type { MovedWalls } from '../lab/movedWalls';
import type { Polygon, Rect, SceneMessage } from '../net/protocol.gen';
import { grown } from '../plan/transform';
import { MovedWallMesh } from './movedWallMesh';
import { ORDER, type Paints } from './paints';
import { dispose } from './solids';
import { RIM_M, roundedRect } from './tray';
import { joined, solidOf } from './traySolid';

/** Height of the floor over the table, so that the two do not flicker. */
const GAP_M = 4e-4;
/** Beyond the farthest view. */
const TABLE_M = 14;

const widened = (rect: Rect, by_m: number): Rect =>
  grown(rect, { left: by_m, right: by_m, top: by_m, bottom: by_m });

/** The rim around the workspace, whose borders are walls too: from a distance of it to its outer side. */
const rimOf = (workspace: Rect, inner_m: number): Polygon => ({
  exterior: roundedRect(widened(workspace, RIM_M)),
  holes: [roundedRect(widened(workspace, inner_m), 0)],
});

/** Material of the sides of walls that have moved. */
const UNSEEN = new MeshBasicMaterial({ visible: false });

export class Table {
  readonly group = new Group();
  private readonly wall: Material;
  private readonly walls: Mesh;
  /** The tray's outer side while the walls move. */
  private readonly skirt: Mesh;
  private moved: MovedWallMesh | undefined;

  constructor(
    private readonly paints: Paints,
    scene: SceneMessage,
  ) {
    const shadows = new Mesh(new PlaneGeometry(TABLE_M, TABLE_M), paints.shadow());
    shadows.position.z = -GAP_M;
    shadows.receiveShadow = true;
    const below = new Group().add(shadows);
    below.renderOrder = ORDER.floor;

    this.wall = paints.lit('wall');
    const { walls, workspace } = scene;
    this.walls = new Mesh(solidOf(joined([...walls, rimOf(workspace, 0)])), this.wall);
    this.skirt = new Mesh(solidOf(joined([rimOf(workspace, RIM_M / 2)])), this.wall);
    this.skirt.position.z = -GAP_M / 4;
    for (const mesh of [this.walls, this.skirt]) {
      mesh.castShadow = true;
      mesh.receiveShadow = true;
    }
    this.group.add(below, this.walls, this.skirt);
    this.skirt.visible = false;
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
    this.skirt.visible = this.moved !== undefined;
    // Sides at rest would flicker through the tops of moved walls.
    this.walls.material = this.moved ? [this.wall, UNSEEN] : this.wall;
  }
}
