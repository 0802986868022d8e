// The materials of the scene in the colours of the palette: one per colour and kind, shared by all objects.

import {
  DoubleSide,
  LineBasicMaterial,
  MeshBasicMaterial,
  MeshStandardMaterial,
  Plane,
  ShadowMaterial,
  Vector3,
  type Color,
  type Material,
  type PerspectiveCamera,
} from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import type { Rect } from '../net/protocol.gen';
import type { Palette } from '../ui/palette';

export type PaintName = keyof Palette;

/**
 * Drawing order. Marks on the floor are visible through the walls, but not through objects over them: marks ignore
 * depth, and solids are drawn after them.
 */
export const ORDER = { floor: -1, marks: 0, bead: 1, solids: 2, air: 3 } as const;

/** Of tissue, and of painted metal. */
const ROUGHNESS = { wall: 0.42, other: 0.38 } as const;
/** A dark tone of the arm's joints. */
const SHADOW_TINT = 0.2;
const SHADOW_OPACITY = 0.28;
/** Share of the own colour that glowing objects emit. */
const GLOW = 0.3;
/** Of the casing of a mark, at each side. */
const CASE_PX = 1.25;

/** In a higher view, bold marks are larger than usual. */
const BOLD_HEIGHT_PX = 250;

type Colored = Material & { readonly color: Color };

interface Paint {
  readonly name: PaintName;
  readonly material: Colored;
  /** Of a stroke, before scaling. */
  readonly width_px?: number;
}

export interface Sheet {
  readonly opacity?: number;
  /** Visible through everything that was drawn before it. */
  readonly through?: boolean;
  /** Only over the workspace. */
  readonly clipped?: boolean;
}

export interface Stroke extends Sheet {
  readonly width_px: number;
  /** Has a light line below it, so that it shows on floor and wall. */
  readonly isCased?: boolean;
}

export class Paints {
  private readonly paints = new Map<string, Paint>();
  /** Of the view. */
  height_px = 1;
  /** Clipping planes at the four sides of the workspace. */
  private readonly borders = [
    new Plane(new Vector3(1, 0, 0)),
    new Plane(new Vector3(-1, 0, 0)),
    new Plane(new Vector3(0, 1, 0)),
    new Plane(new Vector3(0, -1, 0)),
  ] as const;

  constructor(
    private palette: Palette,
    /** Marks can be recognised from far away. */
    private readonly isBold: boolean,
  ) {}

  /** Factor on all sizes in pixels. */
  get markScale(): number {
    return this.isBold ? Math.max(1, this.height_px / BOLD_HEIGHT_PX) : 1;
  }

  /** Size of a pixel of the view at the distance 1. */
  perPx({ fov }: PerspectiveCamera): number {
    return (2 * Math.tan((fov * Math.PI) / 360)) / this.height_px;
  }

  fit(height_px: number): void {
    this.height_px = height_px;
    for (const paint of this.paints.values()) this.apply(paint);
  }

  /** For static parts, lit. */
  lit(name: PaintName): MeshStandardMaterial {
    const roughness = name === 'wall' ? ROUGHNESS.wall : ROUGHNESS.other;
    return this.shared(`lit ${name}`, name, () => new MeshStandardMaterial({ roughness }));
  }

  /** For moving parts over the table: drawn after the marks. Parts of one `set` have one opacity. */
  over(name: PaintName, set = ''): MeshStandardMaterial {
    const look = { roughness: ROUGHNESS.other, transparent: true };
    return this.shared(`over ${set} ${name}`, name, () => new MeshStandardMaterial(look));
  }

  /** For balls, glowing. What hides them must be nearer than the floor's walls. */
  glowing(name: PaintName): MeshStandardMaterial {
    const look = { roughness: 0.3, transparent: true, emissiveIntensity: GLOW };
    return this.shared(`glowing ${name}`, name, () => new MeshStandardMaterial(look));
  }

  /** For flat pictures and the table: nothing but the shadow on it. */
  shadow(): ShadowMaterial {
    return this.shared('shadow', 'arm-seam', () => new ShadowMaterial({ depthWrite: false }));
  }

  /** For drawings: without light and shadow, visible from both sides. */
  flat(name: PaintName, sheet: Sheet): MeshBasicMaterial {
    const look = { side: DoubleSide, ...this.sheet(sheet) };
    const key = `flat ${name} ${JSON.stringify(sheet)}`;
    return this.shared(key, name, () => new MeshBasicMaterial(look));
  }

  stroke(name: PaintName, stroke: Stroke): LineMaterial {
    const look = { clipping: stroke.clipped ?? false, ...this.sheet(stroke) };
    const key = `stroke ${name} ${JSON.stringify(stroke)}`;
    return this.shared(key, name, () => new LineMaterial(look), stroke.width_px);
  }

  /** The light line below a stroke. */
  casing(stroke: Stroke): LineMaterial {
    return this.stroke('case', { ...stroke, width_px: stroke.width_px + 2 * CASE_PX });
  }

  /** Lines of one pixel. */
  edge(name: PaintName): LineBasicMaterial {
    return this.shared(`edge ${name}`, name, () => new LineBasicMaterial());
  }

  /** Sets the opacity of all of `over(…, set)`, from 0 to 1. The magnet stays as it is. */
  fade(set: string, opacity: number): void {
    for (const [key, { name, material }] of this.paints) {
      const isMagnet = name === 'north' || name === 'south';
      if (key.startsWith(`over ${set} `) && !isMagnet) material.opacity = opacity;
    }
  }

  /** Clipping planes for `Sheet.clipped`. */
  overTheTable(): Plane[] {
    return [...this.borders];
  }

  clipTo({ x_min_m, x_max_m, y_min_m, y_max_m }: Rect): void {
    const [left, right, front, back] = this.borders;
    left.constant = -x_min_m;
    right.constant = x_max_m;
    front.constant = -y_min_m;
    back.constant = y_max_m;
  }

  /** The same materials in another palette. */
  recolor(palette: Palette): void {
    this.palette = palette;
    for (const paint of this.paints.values()) this.apply(paint);
  }

  dispose(): void {
    for (const { material } of this.paints.values()) material.dispose();
  }

  private sheet({ opacity = 1, through = false, clipped = false }: Sheet) {
    return {
      transparent: true,
      depthTest: !through,
      depthWrite: false,
      opacity,
      clippingPlanes: clipped ? this.overTheTable() : [],
    };
  }

  private shared<M extends Colored>(
    key: string,
    name: PaintName,
    make: () => M,
    width_px?: number,
  ): M {
    const known = this.paints.get(key);
    // The key names the kind.
    if (known) return known.material as M;
    const material = make();
    material.userData.isShared = true;
    const paint = { name, material, ...(width_px !== undefined && { width_px }) };
    this.apply(paint);
    this.paints.set(key, paint);
    return material;
  }

  private apply({ name, material, width_px }: Paint): void {
    material.color.set(this.palette[name]);
    if (material instanceof ShadowMaterial) {
      material.color.multiplyScalar(SHADOW_TINT);
      material.opacity = SHADOW_OPACITY;
    }
    if (material instanceof LineMaterial && width_px !== undefined) {
      material.linewidth = width_px * this.markScale;
    }
    if (material instanceof MeshStandardMaterial && material.emissiveIntensity === GLOW) {
      material.emissive.copy(material.color);
    }
  }
}
