// Marks on the table and over it: goal, cursor, the tool's place, and the objects of the layers.

import { CircleGeometry, Group, Mesh } from 'three';
import type { History } from '../lab/history';
import { GOAL_RADIUS_M, type SceneMessage, type StateMessage } from '../net/protocol.gen';
import { ORDER, type Paints } from './paints';
import type { LoadedLayer, SceneObject } from './sceneLayer';
import { disposeGeometries } from './solids';
import { Strokes } from './strokes';
import type { Vec2 } from '../lab/geometry';

/** Heights over the floor, so that the marks do not flicker. */
const TOOL_UP_M = 1.2e-3;
const GOAL_UP_M = 1.6e-3;
const CURSOR_UP_M = 2e-3;
const CURSOR_M = [0.004, 0.014] as const;
const TRACKED_M = 0.005;
const CROSS_M = 0.006;

export class Marks {
  readonly group = new Group();
  private readonly goal = new Group();
  private readonly objects: readonly (SceneObject & { readonly id: string })[];
  private readonly tracked: Strokes;
  private readonly cursor: Strokes;
  private readonly spot: Strokes;
  private readonly plumb: Strokes;
  private readonly steering: Strokes;

  constructor(paints: Paints, scene: SceneMessage, layers: readonly LoadedLayer[]) {
    this.objects = layers.map(({ id, create }) => ({ id, ...create(paints, scene) }));
    this.tracked = new Strokes(paints, 'text', 2, { width_px: 1, opacity: 0.8, through: true });
    this.cursor = new Strokes(paints, 'focus', 4, { width_px: 2, through: true });
    this.steering = new Strokes(paints, 'you', 25, { width_px: 2, through: true });
    this.plumb = new Strokes(paints, 'tool', 1, { width_px: 1.25, opacity: 0.8 });
    this.spot = new Strokes(paints, 'tool', 24, { width_px: 1.5, opacity: 0.9, through: true });

    const ring = new Strokes(paints, 'goal', 66, { width_px: 2.5, through: true });
    ring.circle(0, 0, 0, GOAL_RADIUS_M).cross(0, 0, 0, CROSS_M).done();
    const disc = new Mesh(
      new CircleGeometry(GOAL_RADIUS_M, 48),
      paints.flat('goal', { opacity: 0.2, through: true }),
    );
    this.goal.add(disc, ring.object);
    const air = new Group();
    air.renderOrder = ORDER.air;
    air.add(this.plumb.object);
    this.group.renderOrder = ORDER.marks;
    this.group.add(this.goal, air);
    for (const { object } of [
      ...this.objects,
      this.tracked,
      this.cursor,
      this.spot,
      this.steering,
    ]) {
      this.group.add(object);
    }
  }

  /** Updates the marks to `state` and the shown layers. */
  place(state: StateMessage, history: History, layers: ReadonlySet<string>): void {
    const [x, y, z] = state.tool_m;
    for (const one of this.objects) {
      one.object.visible = layers.has(one.id);
      if (one.object.visible) one.place(state, history);
    }
    this.goal.visible = state.goal_m !== null;
    if (state.goal_m) this.goal.position.set(state.goal_m[0], state.goal_m[1], GOAL_UP_M);
    this.tracked
      .clear()
      .cross(...state.bead_tracked_m, TOOL_UP_M, TRACKED_M)
      .done();
    // Marks the tool's place on the table, which is hard to see in perspective.
    this.spot.clear().circle(x, y, TOOL_UP_M, CROSS_M, 24).done();
    const steering = this.steering.clear();
    if (state.steer_m) {
      const [toX, toY] = state.steer_m;
      steering.move(x, y, TOOL_UP_M).line(toX, toY, TOOL_UP_M);
      steering.circle(toX, toY, TOOL_UP_M, CROSS_M, 24);
    }
    steering.done();
    this.plumb.clear().move(x, y, z).line(x, y, TOOL_UP_M).done();
  }

  placeCursor(at: Vec2 | undefined): void {
    const cursor = this.cursor.clear();
    if (at) {
      const [near, far] = CURSOR_M;
      for (const [dx, dy] of [
        [1, 0],
        [-1, 0],
        [0, 1],
        [0, -1],
      ] as const) {
        cursor.move(at[0] + near * dx, at[1] + near * dy, CURSOR_UP_M);
        cursor.line(at[0] + far * dx, at[1] + far * dy, CURSOR_UP_M);
      }
    }
    cursor.done();
  }

  dispose(): void {
    disposeGeometries(this.group);
  }
}
