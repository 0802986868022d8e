// The light of the scene: from the sky, and one lamp that casts shadows.

import { DirectionalLight, Group, HemisphereLight, Vector3 } from 'three';
import type { Rect } from '../net/protocol.gen';

const SKY = '#ffffff';
const SKY_STRENGTH = 1.75;
/** Light reflected by the table from below. */
const BELOW = '#8a8f98';
const LAMP_STRENGTH = 1.9;
/** Direction from the middle of the table to the lamp: over the user's left shoulder. */
const TOWARD_LAMP = new Vector3(-0.3, -0.55, 1.1);
const SHADOW_PX = 1024;
const SHADOW_STRENGTH = 0.65;
/** Half the width of the shadow area around the middle of the table: the arm, or a larger table. */
const SHADOWED_M = 0.62;

export class Light {
  readonly group = new Group();
  private readonly lamp = new DirectionalLight(SKY, LAMP_STRENGTH);

  constructor() {
    this.group.add(new HemisphereLight(SKY, BELOW, SKY_STRENGTH), this.lamp, this.lamp.target);
    this.lamp.castShadow = true;
    const { shadow } = this.lamp;
    shadow.mapSize.set(SHADOW_PX, SHADOW_PX);
    shadow.camera.near = 0.05;
    shadow.camera.far = 4;
    shadow.normalBias = 2e-3;
    shadow.intensity = SHADOW_STRENGTH;
  }

  shineOn({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): void {
    const { position, target, shadow } = this.lamp;
    target.position.set((x_min_m + x_max_m) / 2, (y_min_m + y_max_m) / 2, 0);
    position.copy(target.position).add(TOWARD_LAMP);
    const half_m = Math.max(SHADOWED_M, 0.55 * Math.hypot(x_max_m - x_min_m, y_max_m - y_min_m));
    Object.assign(shadow.camera, {
      left: -half_m,
      right: half_m,
      top: half_m,
      bottom: -half_m,
    }).updateProjectionMatrix();
  }

  dispose(): void {
    this.lamp.dispose();
  }
}
