// Pictures that lie on the table: the floor with the base map, and those under the tool.

import {
  CanvasTexture,
  Group,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  SRGBColorSpace,
  type MeshBasicMaterialParameters,
} from 'three';
import type { FloorPicture } from '../plan/floorPicture';
import type { UnderTool } from '../plan/layer';
import { ORDER, type Paints } from './paints';
import type { Palette } from '../ui/palette';

/** Heights over the floor, so that nothing flickers. */
const SHADOW_UP_M = 3e-4;
const UNDER_TOOL_UP_M = 4e-4;
const UNDER_TOOL_PX = 512;

/** A sheet on the table with the size of its picture's area. */
function lay(
  { canvas, view, ratio }: Omit<FloorPicture, 'workspace'>,
  look: MeshBasicMaterialParameters,
): { sheet: Mesh; texture: CanvasTexture } {
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  const width_m = canvas.width / ratio / view.pxPerM;
  const height_m = canvas.height / ratio / view.pxPerM;
  const sheet = new Mesh(
    new PlaneGeometry(width_m, height_m),
    new MeshBasicMaterial({ ...look, map: texture }),
  );
  const left_m = -view.originX / view.pxPerM;
  const top_m = view.originY / view.pxPerM;
  sheet.position.set(left_m + width_m / 2, top_m - height_m / 2, 0);
  return { sheet, texture };
}

export class Floor {
  readonly group = new Group();
  private readonly texture: CanvasTexture;

  constructor(
    readonly of: FloorPicture,
    paints: Paints,
  ) {
    const { sheet, texture } = lay(of, {});
    this.texture = texture;
    // The picture changes with every camera image, so mipmaps would cost too much.
    texture.generateMipmaps = false;
    texture.minFilter = LinearFilter;
    const shadow = new Mesh(sheet.geometry, paints.shadow());
    shadow.position.copy(sheet.position).setZ(SHADOW_UP_M);
    shadow.receiveShadow = true;
    this.group.renderOrder = ORDER.floor;
    this.group.add(sheet, shadow);
  }

  /** Call this when the picture has changed. */
  refresh(): void {
    this.texture.needsUpdate = true;
  }
}

/** A layer's picture around the origin, like in the plan view. */
export function underTool(picture: UnderTool, palette: Palette, paints: Paints): Mesh {
  const canvas = document.createElement('canvas');
  canvas.width = UNDER_TOOL_PX;
  canvas.height = UNDER_TOOL_PX;
  const ctx = canvas.getContext('2d');
  const half_px = UNDER_TOOL_PX / 2;
  const view = { originX: half_px, originY: half_px, pxPerM: half_px / picture.halfSide_m };
  if (ctx) picture.draw(ctx, view, palette);
  const { sheet } = lay(
    { canvas, view, ratio: 1 },
    {
      transparent: true,
      depthTest: false,
      depthWrite: false,
      clippingPlanes: paints.overTheTable(),
    },
  );
  sheet.position.z = UNDER_TOOL_UP_M;
  return sheet;
}
