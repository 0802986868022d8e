// The bead with its ring, and the hand's spring.

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

const COILS = 10;
const COIL_POINTS = 14;
const COIL_M = 0.0035;
/** Share of straight wire at each end of the spring. */
const LEAD = 0.12;
/** Height of the hand over the table, normally and while it lifts. */
const HAND_UP_M = 0.012;
const LIFTED_UP_M = 0.04;
const UP = new Vector3(0, 0, 1);

/** The spring with a length and a radius of 1, upright. */
function coil(paints: Paints): Strokes {
  const points = COILS * COIL_POINTS;
  const style = { width_px: 2, through: true, isCased: true };
  const spring = new Strokes(paints, 'm-you', points + 2, style);
  spring.move(0, 0, 0);
  for (let i = 0; i <= points; i++) {
    const angle = (2 * Math.PI * i) / COIL_POINTS;
    spring.line(Math.cos(angle), Math.sin(angle), LEAD + ((1 - 2 * LEAD) * i) / points);
  }
  return spring.line(0, 0, 1).done();
}

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
  private readonly spring: Strokes;
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

    this.spring = coil(paints);
    this.grip = new Mesh(new SphereGeometry(0.006, 24, 16), paints.glowing('m-you'));
    this.group.renderOrder = ORDER.bead;
    const air = new Group();
    air.renderOrder = ORDER.air;
    air.add(this.spring.object, this.grip);
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

  /** Draws the spring from the bead to the hand, or removes it. Call it after `place`. */
  pull(pull: Pull | undefined): void {
    const { along, at, grip } = this;
    const spring = this.spring.object;
    grip.visible = pull !== undefined;
    spring.visible = pull !== undefined;
    if (!pull) return;
    grip.position.set(...pull.hand_m, pull.isLifted ? LIFTED_UP_M : HAND_UP_M);
    along.subVectors(grip.position, at);
    const length_m = along.length();
    const radius_m = Math.min(COIL_M, 0.15 * length_m);
    spring.position.copy(at);
    spring.scale.set(radius_m, radius_m, length_m);
    spring.quaternion.setFromUnitVectors(UP, along.normalize());
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
