// What is drawn on the table and over it rather than there: goal, capture, the camera's field, trails, cursor.

import { BufferGeometry, CircleGeometry, Float32BufferAttribute, Group, Mesh } from 'three';
import type { History } from '../lab/history';
import {
  GOAL_RADIUS_M,
  type Parameters,
  type SceneMessage,
  type StateMessage,
} from '../net/protocol.gen';
import type { Layer } from '../lab/layers';
import { TRAIL_S } from '../plan/paint';
import { ORDER, type Paints } from './paints';
import { disposeGeometries, type Point } from './solids';
import { Strokes } from './strokes';
import type { Vec2 } from '../lab/geometry';

/** Heights over the floor, so that nothing flickers. */
const CAPTURE_UP_M = 8e-4;
const TRAIL_UP_M = 1.2e-3;
const GOAL_UP_M = 1.6e-3;
const CURSOR_UP_M = 2e-3;
/** Stands for a reach without an end: beyond every workspace. */
const BEYOND_M = 3;
/** Beyond this many points a trail looks no different. */
const TRAIL_POINTS = 800;
const CURSOR_M = [0.004, 0.014] as const;
const TRACKED_M = 0.005;
const CROSS_M = 0.006;

function triangles(corners: readonly Point[]): BufferGeometry {
  return new BufferGeometry().setAttribute(
    'position',
    new Float32BufferAttribute(corners.flat(), 3),
  );
}

/** A ring of sectors around the tool, since a turned block does not pull alike all round. */
function capture(paints: Paints, capture_m: SceneMessage['capture_m']): Group {
  const sector = (2 * Math.PI) / capture_m.length;
  const at = (k: number, distance_m: number): Point => [
    distance_m * Math.cos(k * sector),
    distance_m * Math.sin(k * sector),
    CAPTURE_UP_M,
  ];
  const fill: Point[] = [];
  const edge = new Strokes(paints, 'tool', 2 * capture_m.length, {
    width_px: 1.25,
    opacity: 0.8,
    through: true,
    clipped: true,
  });
  capture_m.forEach((reach, k) => {
    const next = capture_m[(k + 1) % capture_m.length];
    if (!reach || !next) return;
    const [innerA, innerB] = [at(k, reach[0]), at(k + 1, next[0])];
    const [outerA, outerB] = [at(k, reach[1] ?? BEYOND_M), at(k + 1, next[1] ?? BEYOND_M)];
    fill.push(innerA, outerA, outerB, innerA, outerB, innerB);
    edge.move(...outerA).line(...outerB);
    edge.move(...innerA).line(...innerB);
  });
  edge.done();
  return new Group().add(
    new Mesh(triangles(fill), paints.flat('tool', { opacity: 0.08, through: true, clipped: true })),
    edge.object,
  );
}

/** From the camera's eye to the table that it sees, around the tool. */
function frustum(
  paints: Paints,
  parameters: Parameters,
  sees_m: SceneMessage['camera_sees_m'],
): Group {
  const eye: Point = [
    parameters.camera_offset_x_m,
    parameters.camera_offset_y_m,
    parameters.camera_height_m,
  ];
  const corners = sees_m.map(([x, y]): Point => [x, y, CAPTURE_UP_M]);
  const sides = corners.flatMap((corner, k): Point[] => [
    eye,
    corner,
    corners[(k + 1) % corners.length] ?? corner,
  ]);
  const rays = new Strokes(paints, 'tool', corners.length, { width_px: 1, opacity: 0.4 });
  const foot = new Strokes(paints, 'tool', corners.length, {
    width_px: 1.5,
    opacity: 0.55,
    through: true,
  });
  corners.forEach((corner, k) => {
    rays.move(...eye).line(...corner);
    foot.move(...corner).line(...(corners[(k + 1) % corners.length] ?? corner));
  });
  rays.done();
  foot.done();
  // Among the solids it is as near as it is; on the floor it is a mark.
  const air = new Group();
  air.renderOrder = ORDER.air;
  air.add(new Mesh(triangles(sides), paints.flat('tool', { opacity: 0.045 })), rays.object);
  return new Group().add(air, foot.object);
}

export class Marks {
  readonly group = new Group();
  private readonly goal = new Group();
  private readonly capture: Group;
  private readonly frustum: Group;
  private readonly trails: readonly [tool: Strokes, bead: Strokes];
  private readonly tracked: Strokes;
  private readonly cursor: Strokes;
  private readonly spot: Strokes;
  private readonly plumb: Strokes;

  constructor(paints: Paints, scene: SceneMessage) {
    this.capture = capture(paints, scene.capture_m);
    this.frustum = frustum(paints, scene.parameters, scene.camera_sees_m);
    const trail = { width_px: 1.75, opacity: 0.6, through: true };
    this.trails = [
      new Strokes(paints, 'tool', TRAIL_POINTS + 1, trail),
      new Strokes(paints, 'bead', TRAIL_POINTS + 1, trail),
    ];
    this.tracked = new Strokes(paints, 'text', 2, { width_px: 1, opacity: 0.8, through: true });
    this.cursor = new Strokes(paints, 'focus', 4, { width_px: 2, through: true });
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
    this.group.add(this.capture, this.frustum, this.goal, air);
    for (const { object } of [...this.trails, this.tracked, this.cursor, this.spot]) {
      this.group.add(object);
    }
  }

  /** At `state`, with the layers that are shown. */
  place(state: StateMessage, history: History, layers: ReadonlySet<Layer>): void {
    const [x, y, z] = state.tool_m;
    this.capture.visible = layers.has('capture');
    this.capture.position.set(x, y, 0);
    this.frustum.visible = layers.has('camera');
    this.frustum.position.set(x, y, 0);
    this.goal.visible = state.goal_m !== null;
    if (state.goal_m) this.goal.position.set(state.goal_m[0], state.goal_m[1], GOAL_UP_M);
    this.tracked
      .clear()
      .cross(...state.bead_tracked_m, TRAIL_UP_M, TRACKED_M)
      .done();
    // Where on the table the tool is: in perspective its height hides that.
    this.spot.clear().circle(x, y, TRAIL_UP_M, CROSS_M, 24).done();
    this.plumb.clear().move(x, y, z).line(x, y, TRAIL_UP_M).done();
    this.drawTrails(state, history, layers.has('trail'));
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

  private drawTrails(state: StateMessage, history: History, shown: boolean): void {
    const [toolX, toolY, beadX, beadY] = history.window(
      state.sim_time_s - TRAIL_S,
      state.sim_time_s,
      ['tool_x_m', 'tool_y_m', 'bead_x_m', 'bead_y_m'],
    );
    const draw = (
      strokes: Strokes,
      xs: Float64Array | undefined,
      ys: Float64Array | undefined,
    ): void => {
      strokes.clear();
      if (shown && xs && ys) {
        const stride = Math.max(1, Math.ceil(xs.length / TRAIL_POINTS));
        // From the newest back, which is always there.
        for (let i = xs.length - 1; i >= 0; i -= stride) {
          const [x, y] = [xs[i] ?? 0, ys[i] ?? 0];
          if (i === xs.length - 1) strokes.move(x, y, TRAIL_UP_M);
          else strokes.line(x, y, TRAIL_UP_M);
        }
      }
      strokes.done();
    };
    draw(this.trails[0], toolX, toolY);
    draw(this.trails[1], beadX, beadY);
  }
}
