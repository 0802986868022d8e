// The scene camera on its sphere around a target: pressed pointers, the wheel, keys and buttons move it.

import { Matrix4, PerspectiveCamera, Spherical, Vector3 } from 'three';
import { distance, type TableView, type Vec2 } from '../lab/geometry';
import type { Rect } from '../net/protocol.gen';
import type { Effect } from '../plan/gesture';
import type { Motion } from '../plan/interaction';
import { distanceFor, hidingAt, turnedArrow, type ViewpointName, viewpointOf } from './viewpoints';
import { perspectiveView, pxFromTable, rayAt } from './perspective';

const FIELD_OF_VIEW_DEG = 36;
const FIELD_OF_VIEW_RAD = (FIELD_OF_VIEW_DEG * Math.PI) / 180;
const NEAR_M = 0.02;
const FAR_M = 12;
const MIN_DISTANCE_M = 0.06;
const MAX_DISTANCE_M = 5;
/** From exactly above, the picture would have no defined upper side. */
const MIN_POLAR_RAD = 1e-6;
/** The table is not seen from below. */
const MAX_POLAR_RAD = (88 * Math.PI) / 180;
const KEY_TURN_RAD = Math.PI / 24;
const KEY_ZOOM = 1 / 0.88;
/** Steps of the keys. */
const KEYS: Partial<Record<string, { left?: number; up?: number; away?: number }>> = {
  '[': { left: 1 },
  ']': { left: -1 },
  PageUp: { up: 1 },
  PageDown: { up: -1 },
  '+': { away: -1 },
  '=': { away: -1 },
  '-': { away: 1 },
};
/** Factor of the distance for 100 pixels of the wheel, or of a movement with the middle button. */
const ZOOM_PER_100_PX = 0.95;
/** Two fingers on a touchpad come as a wheel with Ctrl and small steps. */
const TOUCHPAD = { most_px: 50, factor: 10 };

const clamp = (value: number, least: number, most: number): number =>
  Math.min(most, Math.max(least, value));
const zoomBy = (px: number): number => ZOOM_PER_100_PX ** (-px / 100);

export class OrbitCamera implements Motion {
  readonly allButtons = true;
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, NEAR_M, FAR_M);
  private readonly target = new Vector3();
  /** Where the camera is, seen from the target, with the angles of a vertical axis. */
  private readonly seat = new Spherical();
  private readonly clipFromBase = new Matrix4();
  private width_px = 1;
  private height_px = 1;
  private workspace: Rect | undefined;
  /** The chosen viewpoint until the user turns the view. While it is set, its distance follows the canvas size. */
  private viewpoint: ViewpointName | undefined = 'Home';

  constructor(private readonly onChange: () => void) {
    this.camera.up.set(0, 0, 1);
  }

  move({ from, to, press, grip }: Effect & { type: 'move' }): void {
    const by: Vec2 = [to[0] - from[0], to[1] - from[1]];
    const rad = (2 * Math.PI) / this.height_px;
    if (grip === 'turn') this.turn(by[0] * rad, by[1] * rad);
    else if (grip === 'shift') this.shift(by);
    else this.zoom(zoomBy(by[1]), press);
    this.place();
  }

  pinch({ from, to, other }: Effect & { type: 'pinch' }): void {
    const middle: Vec2 = [(to[0] + other[0]) / 2, (to[1] + other[1]) / 2];
    this.zoom(Math.max(1, distance(from, other)) / Math.max(1, distance(to, other)), middle);
    this.shift([(to[0] - from[0]) / 2, (to[1] - from[1]) / 2]);
    this.place();
  }

  wheel({ ctrlKey }: Pick<WheelEvent, 'ctrlKey'>, delta_px: number, at: Vec2): boolean {
    const isTouchpad = ctrlKey && Math.abs(delta_px) < TOUCHPAD.most_px;
    this.zoom(zoomBy(delta_px * (isTouchpad ? TOUCHPAD.factor : 1)), at);
    this.place();
    return true;
  }

  resize(width_px: number, height_px: number): void {
    this.width_px = width_px;
    this.height_px = height_px;
    this.camera.aspect = width_px / height_px;
    this.camera.updateProjectionMatrix();
    if (this.viewpoint) this.take(this.viewpoint);
  }

  /** Sets the workspace. A different workspace resets the view. */
  lookAt(workspace: Rect): void {
    const isSame =
      this.workspace !== undefined && JSON.stringify(workspace) === JSON.stringify(this.workspace);
    this.workspace = workspace;
    if (!isSame) this.take('Home');
  }

  take(name: ViewpointName): void {
    if (!this.workspace) return;
    const viewpoint = viewpointOf(name, this.workspace);
    this.target.set(...viewpoint.target_m);
    const [x, y, z] = viewpoint.toCamera;
    this.seat.setFromCartesianCoords(x, z, -y);
    this.seat.radius = distanceFor(viewpoint, FIELD_OF_VIEW_RAD, this.camera.aspect);
    this.place();
    this.viewpoint = name;
  }

  /** Handles a key. Returns false for other keys. */
  key(key: string): boolean {
    if (key === 'Home') {
      this.take('Home');
      return true;
    }
    const steps = KEYS[key];
    if (!steps) return false;
    const { left = 0, up = 0, away = 0 } = steps;
    this.turn(left * KEY_TURN_RAD, up * KEY_TURN_RAD);
    this.zoom(KEY_ZOOM ** away);
    this.place();
    return true;
  }

  /** Direction on the table of an arrow on the screen. */
  turned(arrow: Vec2): Vec2 {
    return turnedArrow(arrow, this.seat.theta);
  }

  /** Opacity of objects over the table, from 0 to 1: low when seen from above. */
  hiding(): number {
    return hidingAt(this.seat.phi);
  }

  /** The present mapping of the table, with its matrix for tools that read the page. */
  view(): { view: TableView; pxFromTable: readonly number[] } {
    const { camera, clipFromBase, width_px, height_px } = this;
    camera.updateMatrixWorld();
    clipFromBase.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    return {
      view: perspectiveView(camera, width_px, height_px),
      pxFromTable: pxFromTable(clipFromBase, width_px, height_px).transpose().elements,
    };
  }

  private turn(left_rad: number, up_rad: number): void {
    this.seat.theta -= left_rad;
    this.seat.phi = clamp(this.seat.phi - up_rad, MIN_POLAR_RAD, MAX_POLAR_RAD);
  }

  /** Moves the target with the pointer. */
  private shift([right_px, down_px]: Vec2): void {
    const mPerPx = (2 * this.seat.radius * Math.tan(FIELD_OF_VIEW_RAD / 2)) / this.height_px;
    const axis = new Vector3();
    this.target.addScaledVector(
      axis.setFromMatrixColumn(this.camera.matrix, 0),
      -right_px * mPerPx,
    );
    this.target.addScaledVector(axis.setFromMatrixColumn(this.camera.matrix, 1), down_px * mPerPx);
  }

  /** Changes the distance. What is seen at `at` stays there; in the middle by default. */
  private zoom(by: number, at?: Vec2): void {
    const before_m = this.seat.radius;
    this.seat.radius = clamp(before_m * by, MIN_DISTANCE_M, MAX_DISTANCE_M);
    if (!at) return;
    const { camera, target } = this;
    const back = camera.getWorldDirection(new Vector3()).negate();
    const ray = rayAt(camera, at, this.width_px, this.height_px);
    target.addScaledVector(ray.add(back), before_m - this.seat.radius);
  }

  private place(): void {
    const { camera, seat, target } = this;
    this.viewpoint = undefined;
    // The angles of three have an axis along y.
    const { x, y, z } = new Vector3().setFromSpherical(seat);
    camera.position.set(x, -z, y).add(target);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    this.onChange();
  }
}
