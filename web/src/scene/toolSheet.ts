// A layer's picture on the table, like in the plan view: a sheet that moves with the tool.

import { CanvasTexture, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from 'three';
import type { Palette } from '../ui/palette';
import type { UnderTool } from '../plan/layer';
import { ORDER, type Paints } from './paints';

const PICTURE_PX = 512;
/** Height over the floor, above the shadow. */
const UP_M = 4e-4;

export class ToolSheet {
  readonly mesh: Mesh;
  private readonly texture: CanvasTexture;
  private readonly material: MeshBasicMaterial;

  constructor(
    readonly of: UnderTool,
    palette: Palette,
    paints: Paints,
  ) {
    const canvas = document.createElement('canvas');
    canvas.width = PICTURE_PX;
    canvas.height = PICTURE_PX;
    const ctx = canvas.getContext('2d');
    const half_px = PICTURE_PX / 2;
    const view = { originX: half_px, originY: half_px, pxPerM: half_px / of.halfSide_m };
    if (ctx) of.draw(ctx, view, palette);
    this.texture = new CanvasTexture(canvas);
    this.texture.colorSpace = SRGBColorSpace;
    this.material = new MeshBasicMaterial({
      map: this.texture,
      transparent: true,
      depthTest: false,
      depthWrite: false,
      clippingPlanes: paints.overTheTable(),
    });
    const side_m = 2 * of.halfSide_m;
    this.mesh = new Mesh(new PlaneGeometry(side_m, side_m), this.material);
    this.mesh.renderOrder = ORDER.marks;
  }

  place([x_m, y_m]: readonly [number, number, number]): void {
    this.mesh.position.set(x_m, y_m, UP_M);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.texture.dispose();
    this.material.dispose();
  }
}
