// The 3-D scene: takes its inputs and draws one frame when something has changed.

import { Group, PCFShadowMap, Scene, WebGLRenderer } from 'three';
import type { History } from '../lab/history';
import type { MovedWalls } from '../lab/movedWalls';
import type { Palette } from '../ui/palette';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import type { UnderTool } from '../plan/layer';
import type { FloorPicture } from '../plan/floorPicture';
import { Arm, HIDING } from './arm';
import { Bead, type Pull } from './bead';
import { OrbitCamera } from './orbitCamera';
import { Floor } from './floor';
import { Light } from './light';
import { Marks } from './marks';
import type { LoadedLayer } from './sceneLayer';
import { Paints } from './paints';
import { disposeGeometries } from './solids';
import { Table } from './table';
import { Tool } from './tool';
import { ToolSheet } from './toolSheet';
import type { TableView, Vec2 } from '../lab/geometry';

const MAX_PIXEL_RATIO = 2;

/** This browser cannot draw 3-D. */
export class NoWebGl extends Error {}

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
  readonly table: Table;
  readonly tool: Tool;
  readonly marks: Marks;
  readonly bead: Bead;
  readonly group: Group;
}

export class SceneView {
  private readonly renderer: WebGLRenderer;
  private readonly world = new Scene();
  private readonly light = new Light();
  private readonly paints: Paints;
  private readonly arm: Arm;
  readonly orbit: OrbitCamera;
  private setting: Setting | undefined;
  private floor: Floor | undefined;
  private sheets: readonly ToolSheet[] = [];
  private now: Now | undefined;
  private frame: number | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private palette: Palette,
    private readonly layers: readonly LoadedLayer[],
    /** Called when the view of the table has changed. */
    private readonly onView: (view: TableView) => void,
    isBold = false,
  ) {
    // Requested here, because the library logs an error if there is no context.
    const context = canvas.getContext('webgl2', { alpha: true, antialias: true, stencil: false });
    if (!context) throw new NoWebGl();
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.setClearAlpha(0);
    this.renderer.localClippingEnabled = true;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.paints = new Paints(palette, isBold);
    this.arm = new Arm(this.paints);
    this.arm.group.visible = false;
    this.world.add(this.light.group, this.arm.group);
    this.orbit = new OrbitCamera(() => {
      this.updateView();
    });
    canvas.addEventListener('webglcontextrestored', this.request);
  }

  resize(width_px: number, height_px: number): void {
    if (width_px === 0 || height_px === 0) return;
    this.paints.fit(height_px);
    this.renderer.setSize(width_px, height_px, false);
    this.orbit.resize(width_px, height_px);
    this.updateView();
  }

  recolor(palette: Palette): void {
    this.palette = palette;
    this.paints.recolor(palette);
    this.setting?.table.recolor(palette);
    this.setting?.bead.recolor(palette);
    this.request();
  }

  /** Sets up everything that depends on the scene. */
  show(scene: SceneMessage): void {
    this.clear();
    const group = new Group();
    const { paints, palette } = this;
    paints.clipTo(scene.workspace);
    const hasArm = scene.positioner === 'arm';
    const table = new Table(paints, palette, scene);
    const tool = new Tool(
      paints,
      scene.parameters.block_orientation,
      hasArm ? undefined : scene.workspace,
    );
    const marks = new Marks(paints, scene, this.layers);
    const bead = new Bead(paints, palette, scene.bead_radius_m);
    group.add(table.group, tool.group, marks.group, bead.group);
    this.world.add(group);
    this.setting = { scene, table, tool, marks, bead, group };
    this.light.shineOn(scene.workspace);
    this.orbit.lookAt(scene.workspace);
    this.place();
  }

  /** Puts a picture on the floor, or updates the one that is there. */
  lay(picture: FloorPicture): void {
    if (this.floor?.of === picture) {
      this.floor.refresh();
    } else {
      this.removeFloor();
      this.floor = new Floor(picture, this.paints);
      this.world.add(this.floor.group);
    }
    this.request();
  }

  /** Replaces the pictures under the tool. */
  hang(pictures: readonly UnderTool[]): void {
    const stay = this.sheets.filter((sheet) => pictures.includes(sheet.of));
    for (const sheet of this.sheets) if (!stay.includes(sheet)) this.removeSheet(sheet);
    this.sheets = pictures.map(
      (picture) => stay.find(({ of }) => of === picture) ?? this.addSheet(picture),
    );
    this.place();
    this.request();
  }

  update(now: Now): void {
    this.now = now;
    this.place();
  }

  dispose(): void {
    if (this.frame !== undefined) cancelAnimationFrame(this.frame);
    this.canvas.removeEventListener('webglcontextrestored', this.request);
    this.clear();
    this.removeFloor();
    for (const sheet of this.sheets) this.removeSheet(sheet);
    disposeGeometries(this.arm.group);
    this.light.dispose();
    this.paints.dispose();
    this.renderer.dispose();
    // A browser has few contexts and frees unused ones late.
    this.renderer.forceContextLoss();
  }

  private clear(): void {
    if (!this.setting) return;
    const { table, tool, marks, bead, group } = this.setting;
    this.world.remove(group);
    for (const part of [table, tool, marks, bead]) part.dispose();
    this.setting = undefined;
  }

  private removeFloor(): void {
    if (!this.floor) return;
    this.world.remove(this.floor.group);
    this.floor.dispose();
    this.floor = undefined;
  }

  private addSheet(picture: UnderTool): ToolSheet {
    const sheet = new ToolSheet(picture, this.palette, this.paints);
    this.world.add(sheet.mesh);
    return sheet;
  }

  private removeSheet(sheet: ToolSheet): void {
    this.world.remove(sheet.mesh);
    sheet.dispose();
  }

  private place(): void {
    const { now, setting } = this;
    if (!now || !setting) return;
    const { state, pull } = now;
    const { table, tool, marks, bead } = setting;
    table.move(now.walls);
    this.arm.group.visible = state.joints_rad !== null;
    tool.place(state.tool_m, state.joints_rad ? this.arm.pose(state.joints_rad) : 0);
    for (const sheet of this.sheets) sheet.place(state.tool_m);
    marks.place(state, now.history, now.layers);
    marks.placeCursor(now.cursor);
    bead.place(state);
    bead.canGrab(now.nearBead || pull !== undefined);
    bead.pull(pull);
    this.request();
  }

  private updateView(): void {
    const { view, pxFromTable } = this.orbit.view();
    this.canvas.dataset.pxFromTable = pxFromTable.join(',');
    this.onView(view);
    this.request();
  }

  private readonly request = (): void => {
    this.frame ??= requestAnimationFrame(() => {
      this.frame = undefined;
      this.draw();
    });
  };

  draw(wishedRatio = window.devicePixelRatio): void {
    const { setting, now, orbit, renderer } = this;
    if (!setting || !now) return;
    const ratio = Math.min(MAX_PIXEL_RATIO, wishedRatio);
    if (renderer.getPixelRatio() !== ratio) renderer.setPixelRatio(ratio);
    this.paints.fade(HIDING, orbit.hiding());
    setting.bead.fit(orbit.camera);
    renderer.render(this.world, orbit.camera);
  }
}
