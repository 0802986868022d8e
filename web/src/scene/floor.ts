// The floor, with the plan's picture of what lies on it.

import {
  CanvasTexture,
  Group,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  SRGBColorSpace,
  ShadowMaterial,
} from 'three';
import type { GroundPicture } from '../workspace/groundPicture';
import { ORDER, type Paints } from './paints';
import { disposeGeometries } from './solids';

/** Shadows lie this much over the floor, or else the two would flicker. */
const SHADOW_UP_M = 3e-4;
const SHADOW_OPACITY = 0.4;
/** A floor of pure white or black would show neither light nor shadow. */
const HAZE_UP_M = 1e-4;
const HAZE_OPACITY = 0.09;

export class Floor {
  readonly group = new Group();
  private readonly texture: CanvasTexture;
  private readonly picture: MeshBasicMaterial;
  private readonly haze: MeshBasicMaterial;
  private readonly shadow = new ShadowMaterial({ opacity: SHADOW_OPACITY, depthWrite: false });

  constructor(
    readonly of: GroundPicture,
    paints: Paints,
    anisotropy: number,
  ) {
    const { canvas, view, ratio, workspace } = of;
    this.haze = paints.flat('muted', { opacity: HAZE_OPACITY });
    this.texture = new CanvasTexture(canvas);
    this.texture.colorSpace = SRGBColorSpace;
    this.texture.anisotropy = anisotropy;
    // Around the workspace the numbers lie on the table itself.
    this.picture = new MeshBasicMaterial({ map: this.texture, transparent: true });

    const [width_m, height_m] = [canvas.width, canvas.height].map(
      (px) => px / ratio / view.pxPerM,
    ) as [number, number];
    const floor = new Mesh(new PlaneGeometry(width_m, height_m), this.picture);
    const left_m = -view.originX / view.pxPerM;
    const top_m = view.originY / view.pxPerM;
    floor.position.set(left_m + width_m / 2, top_m - height_m / 2, 0);

    const { x_min_m, x_max_m, y_min_m, y_max_m } = workspace;
    const shadow = new Mesh(new PlaneGeometry(x_max_m - x_min_m, y_max_m - y_min_m), this.shadow);
    shadow.position.set((x_min_m + x_max_m) / 2, (y_min_m + y_max_m) / 2, SHADOW_UP_M);
    shadow.receiveShadow = true;
    const haze = new Mesh(shadow.geometry, this.haze);
    haze.position.copy(shadow.position).setZ(HAZE_UP_M);
    floor.renderOrder = -2;
    haze.renderOrder = -1;
    this.group.renderOrder = ORDER.floor;
    this.group.add(floor, haze, shadow);
  }

  /** The picture has been drawn anew. */
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
