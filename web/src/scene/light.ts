// The light of the scene: from the sky, one lamp that casts shadows, and a cool rim from behind.

import { DirectionalLight, Group, HemisphereLight, Vector3 } from 'three';
import type { Rect } from '../net/protocol.gen';

const SKY = '#fcfcff';
/** Light reflected by the table from below. */
const BELOW = '#c9bdb2';
const LAMP = '#fffaf5';
const RIM = '#c4d6ff';
/** Strengths in the light and the dark theme. */
const STRENGTH = {
  light: { sky: 2, lamp: 2.2, rim: 0.6 },
  dark: { sky: 1.3, lamp: 1.6, rim: 1.4 },
};
/** Direction from the middle of the table to the lamp: over the user's left shoulder. */
const TOWARD_LAMP = new Vector3(-0.62, -0.62, 1.25);
const TOWARD_RIM = new Vector3(0.7, 1, 0.5);
/** With and without a graphics card. */
const SHADOW = {
  card: { size_px: 2048, radius_px: 9, samples: 16 },
  slow: { size_px: 768, radius_px: 4, samples: 6 },
};
/** Half the width of the shadow area around the middle of the table: the arm, or a larger table. */
const SHADOWED_M = 0.8;

export class Light {
  readonly group = new Group();
  private readonly sky = new HemisphereLight(SKY, BELOW);
  private readonly lamp = new DirectionalLight(LAMP);
  private readonly rim = new DirectionalLight(RIM);

  constructor(isSlow: boolean) {
    this.group.add(this.sky, this.lamp, this.lamp.target, this.rim, this.rim.target);
    this.lamp.castShadow = true;
    const { shadow } = this.lamp;
    const { size_px, radius_px, samples } = SHADOW[isSlow ? 'slow' : 'card'];
    shadow.mapSize.setScalar(size_px);
    shadow.radius = radius_px;
    shadow.blurSamples = samples;
    shadow.camera.near = 0.05;
    shadow.camera.far = 4;
    shadow.bias = -2e-4;
    shadow.normalBias = 2e-3;
    this.recolor(false);
  }

  recolor(isDark: boolean): void {
    const { sky, lamp, rim } = STRENGTH[isDark ? 'dark' : 'light'];
    this.sky.intensity = sky;
    this.lamp.intensity = lamp;
    this.rim.intensity = rim;
  }

  shineOn({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): void {
    const { position, target, shadow } = this.lamp;
    target.position.set((x_min_m + x_max_m) / 2, (y_min_m + y_max_m) / 2, 0);
    position.copy(target.position).add(TOWARD_LAMP);
    this.rim.target.position.copy(target.position);
    this.rim.position.copy(target.position).add(TOWARD_RIM);
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
