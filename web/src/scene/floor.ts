// Pictures that lie on the table: the floor with the base map, the numbers of the axes around it, and those under the tool.

import {
  CanvasTexture,
  Group,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  SRGBColorSpace,
  ShadowMaterial,
  type Material,
  type MeshBasicMaterialParameters,
} from 'three';
import type { Rect } from '../net/protocol.gen';
import { numbersPicture, type FloorPicture } from '../plan/floorPicture';
import type { UnderTool } from '../plan/layer';
import { ORDER, type Paints } from './paints';
import type { Palette } from '../ui/palette';

/** Height of floor layers over the floor, so that they do not flicker. */
const HAZE_UP_M = 1e-4;
const SHADOW_UP_M = 3e-4;
const UNDER_TOOL_UP_M = 4e-4;
/** The numbers are on the table, a little below the floor. */
const NUMBERS_UP_M = -2e-4;
const SHADOW_OPACITY = 0.4;
/** A pure white or black floor would show no light or shadow. */
const HAZE_OPACITY = 0.09;
const ANISOTROPY = 8;
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
    const over = (material: Material, up_m: number): Mesh => {
      const layer = new Mesh(sheet.geometry, material);
      layer.position.copy(sheet.position).setZ(up_m);
      return layer;
    };
    const haze = over(paints.flat('ink-3', { opacity: HAZE_OPACITY }), HAZE_UP_M);
    const shadow = over(
      new ShadowMaterial({ opacity: SHADOW_OPACITY, depthWrite: false }),
      SHADOW_UP_M,
    );
    shadow.renderOrder = 1;
    shadow.receiveShadow = true;
    this.group.renderOrder = ORDER.floor;
    this.group.add(sheet, haze, shadow);
  }

  /** Call this when the picture has changed. */
  refresh(): void {
    this.texture.needsUpdate = true;
  }
}

export function axisNumbers(palette: Palette, workspace: Rect): Group {
  const { sheet, texture } = lay(numbersPicture(workspace, palette), {
    transparent: true,
    depthWrite: false,
  });
  texture.anisotropy = ANISOTROPY;
  sheet.position.z = NUMBERS_UP_M;
  const group = new Group().add(sheet);
  group.renderOrder = ORDER.floor;
  return group;
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
