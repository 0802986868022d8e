// The floor with the picture of the base map, and the numbers of the axes around it.

import {
  CanvasTexture,
  Group,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  SRGBColorSpace,
  ShadowMaterial,
} from 'three';
import type { Palette } from '../ui/palette';
import type { Rect } from '../net/protocol.gen';
import { createNumbersPicture, type FloorPicture, repaintNumbers } from '../plan/floorPicture';
import { ORDER, type Paints } from './paints';
import { disposeGeometries } from './solids';

/** Height of floor layers over the floor, so that they do not flicker. */
const HAZE_UP_M = 1e-4;
const SHADOW_UP_M = 3e-4;
/** The numbers are on the table, a little below the floor. */
const NUMBERS_UP_M = -2e-4;
const SHADOW_OPACITY = 0.4;
/** A pure white or black floor would show no light or shadow. */
const HAZE_OPACITY = 0.09;
const ANISOTROPY = 8;

/** A sheet on the table with the size of its picture's area. */
function sheet({ canvas, view, ratio }: FloorPicture, material: MeshBasicMaterial): Mesh {
  const width_m = canvas.width / ratio / view.pxPerM;
  const height_m = canvas.height / ratio / view.pxPerM;
  const mesh = new Mesh(new PlaneGeometry(width_m, height_m), material);
  const left_m = -view.originX / view.pxPerM;
  const top_m = view.originY / view.pxPerM;
  mesh.position.set(left_m + width_m / 2, top_m - height_m / 2, 0);
  return mesh;
}

function textureOf({ canvas }: FloorPicture): CanvasTexture {
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

export class Floor {
  readonly group = new Group();
  private readonly texture: CanvasTexture;
  private readonly picture: MeshBasicMaterial;
  private readonly shadow = new ShadowMaterial({ opacity: SHADOW_OPACITY, depthWrite: false });

  constructor(
    readonly of: FloorPicture,
    paints: Paints,
  ) {
    this.texture = textureOf(of);
    // The picture changes with every camera image, so mipmaps would cost too much.
    this.texture.generateMipmaps = false;
    this.texture.minFilter = LinearFilter;
    this.picture = new MeshBasicMaterial({ map: this.texture });
    const floor = sheet(of, this.picture);
    const haze = new Mesh(floor.geometry, paints.flat('muted', { opacity: HAZE_OPACITY }));
    haze.position.copy(floor.position).setZ(HAZE_UP_M);
    const shadow = new Mesh(floor.geometry, this.shadow);
    shadow.position.copy(floor.position).setZ(SHADOW_UP_M);
    shadow.renderOrder = 1;
    shadow.receiveShadow = true;
    this.group.renderOrder = ORDER.floor;
    this.group.add(floor, haze, shadow);
  }

  /** Call this when the picture has changed. */
  refresh(): void {
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    disposeGeometries(this.group);
    this.texture.dispose();
    this.picture.dispose();
    this.shadow.dispose();
  }
}

export class Numbers {
  readonly group = new Group();
  private readonly picture: FloorPicture;
  private readonly texture: CanvasTexture;
  private readonly material: MeshBasicMaterial;

  constructor(palette: Palette, workspace: Rect) {
    this.picture = createNumbersPicture(workspace);
    this.texture = textureOf(this.picture);
    this.texture.anisotropy = ANISOTROPY;
    this.material = new MeshBasicMaterial({
      map: this.texture,
      transparent: true,
      depthWrite: false,
    });
    const mesh = sheet(this.picture, this.material);
    mesh.position.z = NUMBERS_UP_M;
    this.group.renderOrder = ORDER.floor;
    this.group.add(mesh);
    this.recolor(palette);
  }

  recolor(palette: Palette): void {
    repaintNumbers(this.picture, palette);
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    disposeGeometries(this.group);
    this.texture.dispose();
    this.material.dispose();
  }
}
