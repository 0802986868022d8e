// The scene camera on its sphere around a target: pressed pointers, the wheel, keys and buttons move it.

import { Matrix4, PerspectiveCamera, Spherical, Vector3 } from 'three';
import { distance, type TableView, type Vec2 } from '../lab/geometry';
import type { Rect } from '../net/protocol.gen';
import type { Effect } from '../plan/gesture';
import type { Motion } from '../plan/interaction';
import type { Size } from '../ui/size';
import { Flight, planPose, type Pose, type PlanPicture } from './flight';
import {
  hidingAt,
  type Seat,
  seatOf,
  type Lens,
  type Stage,
  stageOf,
  turnedArrow,
  type ViewpointName,
} from './viewpoints';
import { perspectiveView, pxFromTable, rayAt } from './perspective';

const FIELD_OF_VIEW_DEG = 28;
const TANGENT = Math.tan((FIELD_OF_VIEW_DEG * Math.PI) / 360);
const NEAR_M = 0.02;
const FAR_M = 20;
const MIN_DISTANCE_M = 0.06;
const MAX_DISTANCE_M = 8;
/** The view turns between 15° and 89° above the table. */
const MIN_POLAR_RAD = Math.PI / 180;
const MAX_POLAR_RAD = (75 * Math.PI) / 180;
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
  private readonly pose: Pose = { target: new Vector3(), seat: new Spherical(), shift: 0 };
  private readonly clipFromBase = new Matrix4();
  private size: Size = { width: 1, height: 1 };
  private workspace: Rect | undefined;
  private stage: Stage | undefined;
  /** The chosen viewpoint until the user turns the view. While it is set, its distance follows the canvas size. */
  viewpoint: ViewpointName | undefined = 'Home';
  private flight: Flight | undefined;
  /** Called at the end of a flight to the plan view. */
  private land: (() => void) | undefined;

  constructor(
    private readonly onChange: () => void,
    /** Of the picture at the viewpoints. */
    private readonly rest: Pick<Lens, 'shift' | 'below'> = { shift: 0 },
    /** Flights are jumps. */
    private readonly jumps: () => boolean = () => true,
    /** The camera starts there. */
    private plan?: PlanPicture,
  ) {
    this.camera.up.set(0, 0, 1);
  }

  move({ from, to, press, grip }: Effect & { type: 'move' }): void {
    const by: Vec2 = [to[0] - from[0], to[1] - from[1]];
    const rad = (2 * Math.PI) / this.size.height;
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
    this.size = { width: width_px, height: height_px };
    this.camera.aspect = width_px / height_px;
    if (this.plan) this.begin();
    else if (this.viewpoint) this.take(this.viewpoint, true);
    else this.look();
  }

  /** Sets the workspace. A different workspace resets the view. */
  lookAt(workspace: Rect, hasArm = true): void {
    const isSame =
      this.workspace !== undefined && JSON.stringify(workspace) === JSON.stringify(this.workspace);
    this.workspace = workspace;
    this.stage = stageOf(workspace, hasArm);
    if (!isSame) this.begin();
  }

  /** Flies to a viewpoint, or is there at once. */
  take(name: ViewpointName, isJump = this.jumps()): void {
    if (!this.stage) return;
    const lens = { tangent: TANGENT, aspect: this.camera.aspect, ...this.rest };
    const to = this.poseOf(seatOf(name, this.stage, lens));
    this.viewpoint = name;
    this.fly(to, isJump);
  }

  /** Flies to the picture of the plan view. */
  leave(plan: PlanPicture, land: () => void): void {
    const to = planPose(plan, this.size, TANGENT);
    this.viewpoint = undefined;
    this.land = land;
    if (to) this.fly(to, this.jumps());
    else land();
  }

  /** Goes on with a flight. Returns whether it is not over. */
  advance(elapsed_ms: number): boolean {
    if (!this.flight) return false;
    if (this.flight.advance(elapsed_ms)) {
      this.flight = undefined;
      this.land?.();
    }
    this.look();
    return this.flight !== undefined;
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
    return turnedArrow(arrow, this.pose.seat.theta);
  }

  /** Opacity of objects over the table, from 0 to 1: low when seen from above. */
  hiding(): number {
    return hidingAt(this.pose.seat.phi);
  }

  /** The present mapping of the table, with its matrix for tools that read the page. */
  view(): { view: TableView; pxFromTable: readonly number[] } {
    const { camera, clipFromBase, size } = this;
    camera.updateMatrixWorld();
    clipFromBase.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    return {
      view: perspectiveView(camera, size.width, size.height),
      pxFromTable: pxFromTable(clipFromBase, size.width, size.height).transpose().elements,
    };
  }

  /** Starts at home, or with the picture of the plan view and flies home. */
  private begin(): void {
    const from = this.plan && this.size.width > 1 && planPose(this.plan, this.size, TANGENT);
    if (!from || !this.stage) {
      this.take('Home', true);
      return;
    }
    this.plan = undefined;
    this.fly(from, true);
    this.take('Home');
  }

  private fly(to: Pose, isJump: boolean): void {
    this.flight = new Flight(this.pose, to);
    if (isJump) this.advance(Infinity);
    else this.onChange();
  }

  private poseOf({ target_m, toCamera_m: [x, y, z] }: Seat): Pose {
    const seat = new Spherical().setFromCartesianCoords(x, z, -y);
    return { target: new Vector3(...target_m), seat, shift: this.rest.shift };
  }

  private turn(left_rad: number, up_rad: number): void {
    this.pose.seat.theta -= left_rad;
    this.pose.seat.phi = clamp(this.pose.seat.phi - up_rad, MIN_POLAR_RAD, MAX_POLAR_RAD);
  }

  /** Moves the target with the pointer. */
  private shift([right_px, down_px]: Vec2): void {
    const mPerPx = (2 * this.pose.seat.radius * TANGENT) / this.size.height;
    const axis = new Vector3();
    this.pose.target.addScaledVector(
      axis.setFromMatrixColumn(this.camera.matrix, 0),
      -right_px * mPerPx,
    );
    this.pose.target.addScaledVector(
      axis.setFromMatrixColumn(this.camera.matrix, 1),
      down_px * mPerPx,
    );
  }

  /** Changes the distance. What is seen at `at` stays there; in the middle by default. */
  private zoom(by: number, at?: Vec2): void {
    const before_m = this.pose.seat.radius;
    this.pose.seat.radius = clamp(before_m * by, MIN_DISTANCE_M, MAX_DISTANCE_M);
    if (!at) return;
    const { camera, size } = this;
    const back = camera.getWorldDirection(new Vector3()).negate();
    const ray = rayAt(camera, at, size.width, size.height);
    this.pose.target.addScaledVector(ray.add(back), before_m - this.pose.seat.radius);
  }

  /** The user moves the view, which ends a flight. */
  private place(): void {
    this.viewpoint = undefined;
    this.flight = undefined;
    this.look();
  }

  private look(): void {
    const { camera, size } = this;
    const { seat, target, shift } = this.pose;
    const { width, height } = size;
    camera.setViewOffset(width, height, -shift * width, 0, width, height);
    // The angles of three have an axis along y.
    const { x, y, z } = new Vector3().setFromSpherical(seat);
    camera.position.set(x, -z, y).add(target);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    this.onChange();
  }
}
