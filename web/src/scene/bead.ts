// The bead with its halo, and the hand's spring.

import { CanvasTexture, Group, Mesh, SphereGeometry, Sprite, Vector3 } from 'three';
import type { PerspectiveCamera } from 'three';
import type { StateMessage } from '../net/protocol.gen';
import { ORDER, type Paints } from './paints';
import { Strokes } from './strokes';
import type { Pull } from '../plan/paint';

/** The bead has a diameter of 5 mm. From a distance it is enlarged to stay visible. */
const MIN_RADIUS_PX = 5;
const HALO_PX = 13;
const HALO_OPACITY = 0.4;
/** The halo of a bead that a press would grab. */
const GRAB_OPACITY = 0.85;
const SPRITE_PX = 64;

const COILS = 10;
const COIL_POINTS = 14;
const COIL_M = 0.0035;
/** Share of straight wire at each end of the spring. */
const LEAD = 0.12;
/** Height of the hand over the table, normally and while it lifts. */
const HAND_UP_M = 0.006;
const LIFTED_UP_M = 0.03;
const UP = new Vector3(0, 0, 1);

/** A white ring around a glow. The material gives the colour. */
function haloTexture(): CanvasTexture {
  const canvas = document.createElement('canvas');
  canvas.width = SPRITE_PX;
  canvas.height = SPRITE_PX;
  const ctx = canvas.getContext('2d');
  if (ctx) {
    const half = SPRITE_PX / 2;
    const glow = ctx.createRadialGradient(half, half, 0, half, half, half);
    glow.addColorStop(0, 'rgb(255 255 255 / 60%)');
    glow.addColorStop(0.85, 'rgb(255 255 255 / 18%)');
    glow.addColorStop(1, 'rgb(255 255 255 / 0%)');
    ctx.fillStyle = glow;
    ctx.fillRect(0, 0, SPRITE_PX, SPRITE_PX);
    ctx.strokeStyle = 'white';
    ctx.lineWidth = 4;
    ctx.beginPath();
    ctx.arc(half, half, half - 4, 0, 2 * Math.PI);
    ctx.stroke();
  }
  return new CanvasTexture(canvas);
}

/** The spring with a length and a radius of 1, upright. */
function coil(paints: Paints): Strokes {
  const points = COILS * COIL_POINTS;
  const spring = new Strokes(paints, 'you', points + 2, { width_px: 2, through: true });
  spring.move(0, 0, 0);
  for (let i = 0; i <= points; i++) {
    const angle = (2 * Math.PI * i) / COIL_POINTS;
    spring.line(Math.cos(angle), Math.sin(angle), LEAD + ((1 - 2 * LEAD) * i) / points);
  }
  return spring.line(0, 0, 1).done();
}

export class Bead {
  readonly group = new Group();
  private readonly ball: Mesh;
  private readonly halo: Sprite;
  private readonly spring: Strokes;
  private readonly grip: Mesh;
  private readonly at = new Vector3();
  private readonly along = new Vector3();

  constructor(
    private readonly paints: Paints,
    private readonly radius_m: number,
  ) {
    this.ball = new Mesh(new SphereGeometry(1, 28, 18), paints.glowing('bead'));
    this.ball.castShadow = true;
    this.halo = new Sprite(paints.sprite('bead', haloTexture));
    this.spring = coil(paints);
    this.grip = new Mesh(new SphereGeometry(0.004, 18, 12), paints.glowing('you'));
    this.group.renderOrder = ORDER.solids;
    const air = new Group();
    air.renderOrder = ORDER.air;
    air.add(this.halo, this.spring.object);
    this.group.add(this.ball, this.grip, air);
    this.pull(undefined);
  }

  place(state: StateMessage): void {
    this.at.set(...state.bead_m);
  }

  canGrab(near: boolean): void {
    this.halo.material.opacity = near ? GRAB_OPACITY : HALO_OPACITY;
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
    const { height_px, markScale } = this.paints;
    const perPx = (2 * markScale * Math.tan((camera.fov * Math.PI) / 360)) / height_px;
    // Sprites without size attenuation are sized for the distance 1.
    this.halo.scale.setScalar(2 * HALO_PX * perPx);
    const depth_m = this.along.copy(this.at).applyMatrix4(camera.matrixWorldInverse).z;
    const radius_m = Math.max(this.radius_m, -depth_m * perPx * MIN_RADIUS_PX);
    this.ball.scale.setScalar(radius_m);
    this.ball.position.copy(this.at);
    this.ball.position.z += radius_m - this.radius_m;
    this.halo.position.copy(this.ball.position);
  }
}
