// The materials of the scene, in the colours of the palette: one a colour and a kind, shared by all that has it.

import {
  DoubleSide,
  MeshBasicMaterial,
  MeshPhongMaterial,
  type Material,
  type Plane,
  type Color,
} from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import type { Palette } from '../palette';

export type PaintName = keyof Palette;

const SHININESS = 36;
/** Of the reflected light: plastic and painted metal, no mirror. */
const SPECULAR = 0x2a2a2a;

interface Paint {
  readonly name: PaintName;
  readonly material: Material & { readonly color: Color };
}

export interface Stroke {
  readonly width_px: number;
  readonly opacity?: number;
  /** Shown through whatever stands before it. */
  readonly through?: boolean;
  readonly clip?: Plane[];
}

export class Paints {
  private readonly paints = new Map<string, Paint>();

  constructor(private palette: Palette) {}

  /** Of solids, in the light. */
  lit(name: PaintName): MeshPhongMaterial {
    return this.shared(
      `lit ${name}`,
      name,
      () => new MeshPhongMaterial({ shininess: SHININESS, specular: SPECULAR }),
    );
  }

  /** Of what is drawn rather than there: neither light nor shadow, seen from both sides. */
  flat(name: PaintName, opacity: number, clip: Plane[] = []): MeshBasicMaterial {
    const make = (): MeshBasicMaterial =>
      new MeshBasicMaterial({
        side: DoubleSide,
        transparent: true,
        depthWrite: false,
        opacity,
        clippingPlanes: clip,
      });
    return this.shared(`flat ${name} ${opacity} ${clip.length}`, name, make);
  }

  stroke(name: PaintName, stroke: Stroke): LineMaterial {
    const { width_px, opacity = 1, through = false, clip = [] } = stroke;
    const make = (): LineMaterial =>
      new LineMaterial({
        linewidth: width_px,
        transparent: true,
        opacity,
        depthTest: !through,
        depthWrite: false,
        clipping: clip.length > 0,
        clippingPlanes: clip,
      });
    const key = `stroke ${name} ${width_px} ${opacity} ${through} ${clip.length}`;
    return this.shared(key, name, make);
  }

  /** The same materials in another palette. */
  recolor(palette: Palette): void {
    this.palette = palette;
    for (const { name, material } of this.paints.values()) material.color.set(palette[name]);
  }

  dispose(): void {
    for (const { material } of this.paints.values()) material.dispose();
    this.paints.clear();
  }

  private shared<M extends Paint['material']>(key: string, name: PaintName, make: () => M): M {
    const known = this.paints.get(key);
    // The key names the kind.
    if (known) return known.material as M;
    const material = make();
    material.color.set(this.palette[name]);
    this.paints.set(key, { name, material });
    return material;
  }
}
