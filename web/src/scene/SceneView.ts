// The 3-D scene: takes its inputs and draws one frame when something has changed.

import { Group, Scene, Vector3, VSMShadowMap, WebGLRenderer, type Object3D } from 'three';
import type { History } from '../lab/history';
import type { MovedWalls } from '../lab/movedWalls';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import type { UnderTool } from '../plan/layer';
import type { FloorPicture } from '../plan/floorPicture';
import type { PlanPicture } from './flight';
import { Arm } from './arm';
import type { Pull } from '../plan/paint';
import { Bead } from './bead';
import { RING_PX } from './fading';
import { Floor, underTool } from './floor';
import { Frames } from './frames';
import { Light } from './light';
import { Marks } from './marks';
import { OrbitCamera } from './orbitCamera';
import type { LoadedLayer } from './sceneLayer';
import { Paints } from './paints';
import { dispose } from './solids';
import { Table } from './table';
import { Tool } from './tool';
import type { TableView, Vec2 } from '../lab/geometry';
import type { Palette } from '../ui/palette';
import type { Lens } from './viewpoints';

const MAX_PIXEL_RATIO = 2;
const NO_WEBGL =
  'This browser cannot show the 3-D view: it has no WebGL 2, or WebGL 2 is switched off.';

export interface Now {
  readonly state: StateMessage;
  readonly history: History;
  /** Undefined while they are at rest. */
  readonly walls: MovedWalls | undefined;
  readonly layers: ReadonlySet<string>;
  readonly pull: Pull | undefined;
  readonly nearBead: boolean;
  readonly cursor: Vec2 | undefined;
}

/** The solid objects of one scene. */
interface Setting {
  readonly scene: SceneMessage;
  readonly group: Group;
  readonly table: Table;
  readonly tool: Tool;
  readonly marks: Marks;
  readonly bead: Bead;
}

export interface Colours {
  readonly palette: Palette;
  readonly isDark: boolean;
}

export interface SceneOptions {
  readonly colours: Colours;
  readonly layers: readonly LoadedLayer[];
  /** Called when the view of the table has changed. */
  readonly onView: (view: TableView) => void;
  /** Bead, trails and goal can be recognised from far away. */
  readonly isBold: boolean;
  /** Where the stage is in the picture at the viewpoints. */
  readonly rest: Pick<Lens, 'shift' | 'below'>;
  /** There is no graphics card. */
  readonly isSlow: boolean;
  readonly wantsLessMotion: () => boolean;
  /** The view starts with the picture of the plan view. */
  readonly plan: PlanPicture | undefined;
}

export class SceneView {
  private readonly renderer: WebGLRenderer;
  private readonly world = new Scene();
  private readonly light: Light;
  private readonly paints: Paints;
  private readonly arm: Arm;
  readonly orbit: OrbitCamera;
  private setting: Setting | undefined;
  private floor: Floor | undefined;
  /** Pictures that move with the tool. */
  private readonly underTool = new Group();
  private now: Now | undefined;
  private colours: Colours;
  private readonly frames = new Frames((elapsed_ms) => this.advance(elapsed_ms));

  /** Throws an error for the user if this browser cannot draw 3-D. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly options: SceneOptions,
  ) {
    // Requested here, because the library logs an error if there is no context.
    const context = canvas.getContext('webgl2', { alpha: true, antialias: true, stencil: false });
    if (!context) throw new Error(NO_WEBGL);
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.setClearAlpha(0);
    this.renderer.localClippingEnabled = true;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = VSMShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.colours = options.colours;
    this.paints = new Paints(this.colours.palette, options.isBold);
    this.light = new Light(options.isSlow);
    this.arm = new Arm(this.paints);
    this.arm.group.visible = false;
    this.world.add(this.light.group, this.arm.group, this.underTool);
    this.orbit = new OrbitCamera(
      () => this.updateView(),
      options.rest,
      options.wantsLessMotion,
      options.plan,
    );
    this.recolor(this.colours);
    canvas.addEventListener('webglcontextrestored', this.changed);
  }

  resize(width_px: number, height_px: number): void {
    if (width_px === 0 || height_px === 0) return;
    this.paints.fit(height_px);
    this.renderer.setSize(width_px, height_px, false);
    this.orbit.resize(width_px, height_px);
    this.updateView();
  }

  recolor(colours: Colours): void {
    this.colours = colours;
    this.paints.recolor(colours.palette);
    this.arm.recolor(colours.palette['ink-2']);
    this.light.recolor(colours.isDark);
    this.frames.request();
  }

  /** Sets up everything that depends on the scene. */
  show(scene: SceneMessage): void {
    this.remove(this.setting?.group);
    const group = new Group();
    const { paints } = this;
    paints.clipTo(scene.workspace);
    const hasArm = scene.positioner === 'arm';
    const table = new Table(paints, scene);
    const tool = new Tool(
      paints,
      scene.parameters.block_orientation,
      hasArm ? undefined : scene.workspace,
    );
    const marks = new Marks(paints, scene, this.options.layers);
    const bead = new Bead(paints, scene.bead_radius_m);
    group.add(table.group, tool.group, marks.group, bead.group);
    this.world.add(group);
    this.setting = { scene, group, table, tool, marks, bead };
    this.light.shineOn(scene.workspace);
    this.orbit.lookAt(scene.workspace, hasArm);
    this.place();
  }

  /** Puts a picture on the floor, or updates the one that is there. */
  lay(picture: FloorPicture): void {
    if (this.floor?.of === picture) {
      this.floor.refresh();
    } else {
      this.remove(this.floor?.group);
      this.floor = new Floor(picture, this.paints);
      this.world.add(this.floor.group);
    }
    this.frames.request();
  }

  /** Replaces the pictures under the tool. */
  hang(pictures: readonly UnderTool[]): void {
    for (const sheet of [...this.underTool.children]) this.remove(sheet);
    const { palette } = this.colours;
    const sheets = pictures.map((picture) => underTool(picture, palette, this.paints));
    if (sheets.length > 0) this.underTool.add(...sheets);
    this.place();
    this.frames.request();
  }

  update(now: Now): void {
    this.now = now;
    this.place();
  }

  dispose(): void {
    this.frames.stop();
    this.canvas.removeEventListener('webglcontextrestored', this.changed);
    dispose(this.world);
    this.light.dispose();
    this.paints.dispose();
    this.arm.dispose();
    this.renderer.dispose();
    // A browser has few contexts and frees unused ones late.
    this.renderer.forceContextLoss();
  }

  private remove(object: Object3D | undefined): void {
    if (!object) return;
    object.removeFromParent();
    dispose(object);
  }

  private place(): void {
    const { now, setting } = this;
    if (!now || !setting) return;
    const { state, pull } = now;
    const { table, tool, marks, bead } = setting;
    table.move(now.walls);
    this.arm.group.visible = state.joints_rad !== null;
    tool.place(state.tool_m, state.joints_rad ? this.arm.pose(state.joints_rad) : 0);
    this.underTool.position.set(state.tool_m[0], state.tool_m[1], 0);
    marks.place(state, now.history, now.layers);
    marks.placeCursor(now.cursor);
    bead.place(state);
    bead.canGrab(now.nearBead || pull !== undefined);
    bead.pull(pull);
    this.changed();
  }

  private updateView(): void {
    const { view, pxFromTable } = this.orbit.view();
    this.canvas.dataset.pxFromTable = pxFromTable.join(',');
    this.options.onView(view);
    this.frames.request();
  }

  /** Something has moved that casts a shadow. */
  private readonly changed = (): void => {
    this.renderer.shadowMap.needsUpdate = true;
    this.frames.request();
  };

  /** Draws the next frame. Returns whether something moves on its own. */
  private advance(elapsed_ms: number): boolean {
    const flies = this.orbit.advance(elapsed_ms);
    const fades = this.fade(elapsed_ms);
    this.draw();
    return flies || fades;
  }

  /** Links that cover the bead or the goal become transparent. */
  private fade(elapsed_ms: number): boolean {
    const { arm, now, options, orbit, paints } = this;
    if (!now) return false;
    const { bead_m, goal_m } = now.state;
    const covered = {
      eye: orbit.camera.position,
      places: [bead_m, ...(goal_m ? [goal_m] : [])].map((at) => new Vector3(...at)),
      ringPerM: RING_PX * paints.perPx(orbit.camera),
    };
    return arm.fade(covered, elapsed_ms, options.wantsLessMotion(), orbit.hiding());
  }

  /** Draws a frame now, if there is something to draw. */
  readonly draw = (wishedRatio = window.devicePixelRatio): HTMLCanvasElement | undefined => {
    const { setting, now, orbit, renderer } = this;
    if (!setting || !now) return undefined;
    const ratio = Math.min(MAX_PIXEL_RATIO, wishedRatio);
    if (renderer.getPixelRatio() !== ratio) renderer.setPixelRatio(ratio);
    setting.bead.fit(orbit.camera);
    renderer.render(this.world, orbit.camera);
    return this.canvas;
  };
}
