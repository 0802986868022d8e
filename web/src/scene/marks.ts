// Marks on the table and over it: goal, cursor, the tool's place, and the objects of the layers.

import { CircleGeometry, Group, Mesh, type Object3D } from 'three';
import type { History } from '../lab/history';
import { GOAL_RADIUS_M, type SceneMessage, type StateMessage } from '../net/protocol.gen';
import { startOf } from '../plan/paint';
import { ORDER, type PaintName, type Paints } from './paints';
import type { LoadedLayer, SceneObject } from './sceneLayer';
import { Strokes } from './strokes';
import type { Vec2 } from '../lab/geometry';

/** Heights over the floor, so that the marks do not flicker. */
const TOOL_UP_M = 1.2e-3;
const GOAL_UP_M = 1.6e-3;
const CURSOR_UP_M = 2e-3;
const CURSOR_M = [0.004, 0.014] as const;
const TRACKED_M = 0.005;
const CROSS_M = 0.006;
const START_M = 0.005;

/** Four lines around a free middle. */
function crosshair(paints: Paints): Strokes {
  const style = { width_px: 2, through: true, isCased: true };
  const lines = new Strokes(paints, 'accent', 4, style);
  const [near, far] = CURSOR_M;
  for (const side of [-1, 1]) {
    lines.move(side * near, 0, 0).line(side * far, 0, 0);
    lines.move(0, side * near, 0).line(0, side * far, 0);
  }
  return lines.done();
}

export class Marks {
  readonly group = new Group();
  private readonly goal = new Group();
  private readonly start: Object3D;
  private readonly objects: readonly (SceneObject & { readonly id: string })[];
  private readonly tracked: Object3D;
  private readonly cursor: Object3D;
  /** The tool's place on the table, which is hard to see in perspective. */
  private readonly spot: Object3D;
  /** From the tool down to the table. */
  private readonly plumb: Object3D;
  private readonly steering: Strokes;

  constructor(
    paints: Paints,
    private readonly scene: SceneMessage,
    layers: readonly LoadedLayer[],
  ) {
    const strokes = (name: PaintName, capacity: number, width_px: number): Strokes =>
      new Strokes(paints, name, capacity, { width_px, through: true, isCased: true });
    this.objects = layers.map(({ id, create }) => ({ id, ...create(paints, scene) }));
    const tracked = strokes('magnet', 2, 1);
    this.tracked = tracked.cross(0, 0, 0, TRACKED_M).done().object;
    this.cursor = crosshair(paints).object;
    this.steering = strokes('m-you', 25, 2);
    const plumb = new Strokes(paints, 'magnet', 1, { width_px: 1.25, opacity: 0.8 });
    this.plumb = plumb.move(0, 0, 0).line(0, 0, 1).done().object;
    const spot = strokes('magnet', 24, 1.5);
    this.spot = spot.circle(0, 0, 0, CROSS_M, 24).done().object;

    this.start = strokes('m-ink', 24, 2).circle(0, 0, 0, START_M, 24).done().object;

    const ring = strokes('m-goal', 66, 2.5);
    ring.circle(0, 0, 0, GOAL_RADIUS_M).cross(0, 0, 0, CROSS_M).done();
    const disc = new Mesh(
      new CircleGeometry(GOAL_RADIUS_M, 48),
      paints.flat('m-goal', { opacity: 0.16, through: true }),
    );
    this.goal.add(disc, ring.object);
    const air = new Group();
    air.renderOrder = ORDER.air;
    air.add(this.plumb);
    this.group.renderOrder = ORDER.marks;
    this.group.add(this.start, this.goal, air, ...this.objects.map(({ object }) => object));
    this.group.add(this.tracked, this.cursor, this.spot, this.steering.object);
  }

  /** Updates the marks to `state` and the shown layers. */
  place(state: StateMessage, history: History, layers: ReadonlySet<string>): void {
    const [x, y, z] = state.tool_m;
    for (const one of this.objects) {
      one.object.visible = layers.has(one.id);
      if (one.object.visible) one.place(state, history);
    }
    const start = startOf(this.scene, history);
    this.start.visible = start !== undefined;
    if (start) this.start.position.set(...start, TOOL_UP_M);
    this.goal.visible = state.goal_m !== null;
    if (state.goal_m) this.goal.position.set(state.goal_m[0], state.goal_m[1], GOAL_UP_M);
    this.tracked.position.set(...state.bead_tracked_m, TOOL_UP_M);
    this.spot.position.set(x, y, TOOL_UP_M);
    this.plumb.position.copy(this.spot.position);
    this.plumb.scale.z = z - TOOL_UP_M;
    const steering = this.steering.clear();
    if (state.steer_m) {
      const [toX, toY] = state.steer_m;
      steering.move(x, y, TOOL_UP_M).line(toX, toY, TOOL_UP_M);
      steering.circle(toX, toY, TOOL_UP_M, CROSS_M, 24);
    }
    steering.done();
  }

  placeCursor(at: Vec2 | undefined): void {
    this.cursor.visible = at !== undefined;
    if (at) this.cursor.position.set(...at, CURSOR_UP_M);
  }
}
