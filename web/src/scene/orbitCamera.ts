// The scene camera: mouse and touch turn it (OrbitControls of three), keys and buttons too.

import { MOUSE, Matrix4, PerspectiveCamera } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Rect } from '../net/protocol.gen';
import { distanceFor, hidingAt, turnedArrow, type ViewpointName, viewpointOf } from './viewpoints';
import { perspectiveView, pxFromTable } from './perspective';
import type { TableView, Vec2 } from '../lab/geometry';

const FIELD_OF_VIEW_DEG = 36;
const NEAR_M = 0.02;
const FAR_M = 12;
const MIN_DISTANCE_M = 0.06;
const MAX_DISTANCE_M = 5;
/** The table is not seen from below. */
const MAX_POLAR_RAD = (88 * Math.PI) / 180;
const KEY_TURN_RAD = Math.PI / 24;
const KEY_ZOOM = 0.88;

export class OrbitCamera {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, NEAR_M, FAR_M);
  private readonly controls: OrbitControls;
  private readonly clipFromBase = new Matrix4();
  private width_px = 1;
  private height_px = 1;
  private workspace: Rect | undefined;
  /** The chosen viewpoint until the user turns the view. While it is set, its distance follows the canvas size. */
  private viewpoint: ViewpointName | undefined = 'Home';

  constructor(canvas: HTMLCanvasElement, onChange: () => void) {
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = MAX_POLAR_RAD;
    this.controls.minDistance = MIN_DISTANCE_M;
    this.controls.maxDistance = MAX_DISTANCE_M;
    this.controls.zoomToCursor = true;
    this.controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.addEventListener('start', () => {
      this.viewpoint = undefined;
    });
    this.controls.addEventListener('change', onChange);
  }

  /** Whether a press turns the view; not while it holds the bead. */
  setFree(free: boolean): void {
    this.controls.enabled = free;
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
    this.viewpoint = name;
    const viewpoint = viewpointOf(name, this.workspace);
    const away_m = distanceFor(viewpoint, (FIELD_OF_VIEW_DEG * Math.PI) / 180, this.camera.aspect);
    this.controls.target.set(...viewpoint.target_m);
    this.camera.position
      .set(...viewpoint.toCamera)
      .setLength(away_m)
      .add(this.controls.target);
    this.controls.update();
  }

  /** Handles a key. Returns false for other keys. */
  key(key: string): boolean {
    switch (key) {
      case '[':
        this.controls.rotateLeft(KEY_TURN_RAD);
        break;
      case ']':
        this.controls.rotateLeft(-KEY_TURN_RAD);
        break;
      case 'PageUp':
        this.controls.rotateUp(KEY_TURN_RAD);
        break;
      case 'PageDown':
        this.controls.rotateUp(-KEY_TURN_RAD);
        break;
      case '+':
      case '=':
        this.controls.dollyIn(KEY_ZOOM);
        break;
      case '-':
        this.controls.dollyOut(KEY_ZOOM);
        break;
      case 'Home':
        this.take('Home');
        return true;
      default:
        return false;
    }
    this.viewpoint = undefined;
    return true;
  }

  /** Direction on the table of an arrow on the screen. */
  turned(arrow: Vec2): Vec2 {
    return turnedArrow(arrow, this.controls.getAzimuthalAngle());
  }

  /** Opacity of objects over the table, from 0 to 1: low when seen from above. */
  hiding(): number {
    return hidingAt(this.controls.getPolarAngle());
  }

  /** The present mapping of the table, with its matrix for tools that read the page. */
  view(): { view: TableView; pxFromTable: readonly number[] } {
    const { camera, clipFromBase, width_px, height_px } = this;
    camera.updateMatrixWorld();
    clipFromBase.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    return {
      view: perspectiveView(clipFromBase, width_px, height_px),
      pxFromTable: pxFromTable(clipFromBase, width_px, height_px).transpose().elements,
    };
  }

  dispose(): void {
    this.controls.dispose();
  }
}
