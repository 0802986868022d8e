// The bead with its ring, and the arrow of the hand's pull.

import { AlwaysDepth, CircleGeometry, Group, Mesh, Object3D, SphereGeometry, Vector3 } from 'three';
import type { PerspectiveCamera } from 'three';
import type { StateMessage } from '../net/protocol.gen';
import { ORDER, type Paints } from './paints';
import { Strokes } from './strokes';
import type { Pull } from '../plan/paint';

/** The bead has a diameter of 5 mm. It is drawn larger. */
const ENLARGED = 3.8;
/** From a distance it is enlarged further, to stay visible. */
const MIN_RADIUS_PX = 5;
const RING_PX = 17;
const RING_UP_M = 1.8e-3;
const DASHES = 10;
/** Of the ring's area, and while a press would grab the bead. */
const FILL_OPACITY = { free: 0.16, near: 0.4 };

/** Of the arrow: a dash with its gap, the share of the dash, and the two lines of its head. */
const DASH_M = 0.014;
const DASH = 0.6;
const HEAD_M = 0.014;
const HEAD_RAD = 0.45;
const MOST_DASHES = 80;
/** Height of the hand over the table, normally and while it lifts. */
const HAND_UP_M = 0.012;
const LIFTED_UP_M = 0.04;

/** A dashed circle with a radius of 1. */
function dashedRing(paints: Paints): Strokes {
  const pieces = 4;
  const style = { width_px: 2, through: true, isCased: true };
  const ring = new Strokes(paints, 'bead', DASHES * pieces, style);
  for (let dash = 0; dash < DASHES; dash++) {
    for (let i = 0; i <= pieces; i++) {
      const angle = (2 * Math.PI * (dash + (0.7 * i) / pieces)) / DASHES;
      const at = [Math.cos(angle), Math.sin(angle), 0] as const;
      if (i === 0) ring.move(...at);
      else ring.line(...at);
    }
  }
  return ring.done();
}

export class Bead {
  readonly group = new Group();
  private readonly ball = new Object3D();
  private readonly ring = new Object3D();
  private readonly fills: { free: Mesh; near: Mesh };
  private readonly arrow: Strokes;
  private readonly grip: Mesh;
  private readonly at = new Vector3();
  private readonly along = new Vector3();

  constructor(
    private readonly paints: Paints,
    private readonly radius_m: number,
  ) {
    const sphere = new SphereGeometry(1, 40, 28);
    const solid = new Mesh(sphere, paints.glowing('bead'));
    solid.castShadow = true;
    // It shows through the walls, which are drawn before it, but not through the arm.
    solid.material.depthFunc = AlwaysDepth;
    this.ball.add(solid);

    const disc = new CircleGeometry(1, 48);
    const fill = (opacity: number): Mesh =>
      new Mesh(disc, paints.flat('bead', { opacity, through: true }));
    this.fills = { free: fill(FILL_OPACITY.free), near: fill(FILL_OPACITY.near) };
    this.ring.add(this.fills.free, this.fills.near, dashedRing(paints).object);
    const marks = new Group();
    marks.renderOrder = ORDER.marks;
    marks.add(this.ring);

    const style = { width_px: 3, through: true, isCased: true };
    this.arrow = new Strokes(paints, 'm-you', MOST_DASHES + 2, style);
    this.grip = new Mesh(new SphereGeometry(0.006, 24, 16), paints.glowing('m-you'));
    this.group.renderOrder = ORDER.bead;
    const air = new Group();
    air.renderOrder = ORDER.air;
    air.add(this.arrow.object, this.grip);
    this.group.add(this.ball, marks, air);
    this.pull(undefined);
    this.canGrab(false);
  }

  place(state: StateMessage): void {
    this.at.set(...state.bead_m);
  }

  canGrab(near: boolean): void {
    this.fills.near.visible = near;
    this.fills.free.visible = !near;
  }

  /** Draws the arrow from the bead to the hand, or removes it. Call it after `place`. */
  pull(pull: Pull | undefined): void {
    const { along, at, grip } = this;
    const arrow = this.arrow.clear();
    grip.visible = pull !== undefined;
    if (pull) {
      grip.position.set(...pull.hand_m, pull.isLifted ? LIFTED_UP_M : HAND_UP_M);
      along.subVectors(grip.position, at);
      const length_m = along.length();
      const dashes = Math.min(MOST_DASHES, Math.ceil(length_m / DASH_M));
      for (let i = 0; i < dashes; i++) {
        const [from, to] = [i / dashes, Math.min(1, (i + DASH) / dashes)];
        arrow.move(at.x + from * along.x, at.y + from * along.y, at.z + from * along.z);
        arrow.line(at.x + to * along.x, at.y + to * along.y, at.z + to * along.z);
      }
      const back_rad = Math.atan2(-along.y, -along.x);
      const { x, y, z } = grip.position;
      for (const side of length_m > HEAD_M ? [-HEAD_RAD, HEAD_RAD] : []) {
        const angle = back_rad + side;
        arrow.move(x, y, z);
        arrow.line(x + HEAD_M * Math.cos(angle), y + HEAD_M * Math.sin(angle), z);
      }
    }
    arrow.done();
  }

  /** Sets the sizes that are given in screen pixels. */
  fit(camera: PerspectiveCamera): void {
    const { at, ball, paints, radius_m: real_m, ring } = this;
    const depth_m = -this.along.copy(at).applyMatrix4(camera.matrixWorldInverse).z;
    const perPx = depth_m * paints.perPx(camera) * paints.markScale;
    const radius_m = Math.max(ENLARGED * real_m, MIN_RADIUS_PX * perPx);
    ball.scale.setScalar(radius_m);
    ball.position.set(at.x, at.y, at.z + radius_m - real_m);
    ring.scale.setScalar(Math.max(1.5 * radius_m, RING_PX * perPx));
    ring.position.set(at.x, at.y, RING_UP_M);
  }
}
