// The materials of the scene in the colours of the palette: one per colour and kind, shared by all objects.

import {
  DoubleSide,
  LineBasicMaterial,
  MeshBasicMaterial,
  MeshPhongMaterial,
  Plane,
  SpriteMaterial,
  Vector3,
  type Color,
  type Material,
  type Texture,
} from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import type { Rect } from '../net/protocol.gen';
import type { Palette } from '../ui/palette';

export type PaintName = keyof Palette;

/**
 * Drawing order. Marks on the floor are visible through the walls, but not through objects over them: marks ignore
 * depth, and solids are drawn after them.
 */
export const ORDER = { floor: -1, marks: 0, solids: 1, air: 2 } as const;

/** Like plastic and painted metal, not like a mirror. */
const GLOSS = { shininess: 36, specular: 0x2a2a2a };
/** Share of the own colour that glowing objects emit. */
const GLOW = 0.45;

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

  fit(height_px: number): void {
    this.height_px = height_px;
    for (const paint of this.paints.values()) this.apply(paint);
  }

  /** For static parts, lit. */
  lit(name: PaintName): MeshPhongMaterial {
    return this.shared(`lit ${name}`, name, () => new MeshPhongMaterial(GLOSS));
  }

  /** For moving parts over the table: drawn after the marks, with variable opacity. */
  over(name: PaintName): MeshPhongMaterial {
    const look = { ...GLOSS, transparent: true };
    return this.shared(`over ${name}`, name, () => new MeshPhongMaterial(look));
  }

  /** For moving parts, glowing. */
  glowing(name: PaintName): MeshPhongMaterial {
    const look = { ...GLOSS, transparent: true, emissiveIntensity: GLOW };
    return this.shared(`glowing ${name}`, name, () => new MeshPhongMaterial(look));
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

  /** Lines of one pixel. */
  edge(name: PaintName): LineBasicMaterial {
    return this.shared(`edge ${name}`, name, () => new LineBasicMaterial());
  }

  /** A picture that faces the camera, visible also behind the arm and the walls. */
  sprite(name: PaintName, picture: () => Texture): SpriteMaterial {
    const look = { sizeAttenuation: false, ...this.sheet({ through: true }) };
    return this.shared(
      `sprite ${name}`,
      name,
      () => new SpriteMaterial({ ...look, map: picture() }),
    );
  }

  /** Sets the opacity of `over(name)`, from 0 to 1. */
  fade(names: readonly PaintName[], opacity: number): void {
    for (const name of names) this.over(name).opacity = opacity;
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
    for (const { material } of this.paints.values()) {
      if (material instanceof SpriteMaterial) material.map?.dispose();
      material.dispose();
    }
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
    if (material instanceof LineMaterial && width_px !== undefined) {
      material.linewidth = width_px * this.markScale;
    }
    if (material instanceof MeshPhongMaterial && material.emissiveIntensity === GLOW) {
      material.emissive.copy(material.color);
    }
  }
}
