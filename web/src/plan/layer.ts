// Layers of the map. A feature exports its layers; `app` lists them in drawing order.

import { createMemo, type Accessor, type JSX } from 'solid-js';
import type { History } from '../lab/history';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import type { Palette } from '../ui/palette';
import type { View } from './transform';
import type { Lab } from '../lab/slices';

/** Headings of the menu, in its order. */
export const LAYER_GROUPS = ['Motion', 'Camera', 'RL', 'ERRT', 'Attractor', 'Arm'] as const;

export interface BasePicture {
  readonly view: View;
  readonly palette: Palette;
  readonly scene: SceneMessage;
}

export interface MovingPicture extends BasePicture {
  readonly state: StateMessage;
  readonly history: History;
}

export type Draw<P extends BasePicture> = (ctx: CanvasRenderingContext2D, picture: P) => void;

/**
 * Called once for each surface, so that results that depend on its view can be memos. The accessor returns `undefined`
 * while there is nothing to draw. It is read only while the layer is shown.
 */
export type BaseDrawing = (
  view: Accessor<View | undefined>,
) => Accessor<Draw<BasePicture> | undefined>;

/** A square picture with its middle below the tool. The 3-D scene moves it with the tool. */
export interface UnderTool {
  readonly halfSide_m: number;
  readonly draw: (ctx: CanvasRenderingContext2D, view: View, palette: Palette) => void;
}

/** The parts of a layer. Each is optional. */
export interface LayerParts {
  readonly belowWalls?: BaseDrawing;
  readonly aboveWalls?: BaseDrawing;
  /** Drawn with every state, above the base map and below goal, tool and bead. */
  readonly moving?: Accessor<Draw<MovingPicture> | undefined>;
  readonly underTool?: Accessor<UnderTool | undefined>;
  readonly legend?: () => JSX.Element;
}

export interface LayerContext<L = Lab> {
  readonly lab: L;
  readonly palette: Accessor<Palette>;
  readonly isShown: Accessor<boolean>;
}

export interface MapLayer {
  /** Stored by the browser and used by tests. */
  readonly id: string;
  readonly label: string;
  /** The colours of its marks, for the menu. */
  readonly swatch: readonly [keyof Palette, ...(keyof Palette)[]];
  readonly group: (typeof LAYER_GROUPS)[number];
  readonly shownAtFirst?: true;
  /** `aboveWalls` may draw outside the workspace. */
  readonly isUnclipped?: true;
  /** Shows only what sensors tell, so that it may be drawn over fog. */
  readonly isSensed?: true;
  /** Why the layer cannot be shown now; undefined if it can. */
  readonly unavailable?: (lab: Lab) => string | undefined;
  create(context: LayerContext): LayerParts;
}

/** A layer with its parts, for one laboratory. */
export type LiveLayer<L extends MapLayer = MapLayer> = L &
  LayerParts & { readonly isShown: Accessor<boolean> };

/** Why a layer is not shown now, whatever the user chose; undefined if it can be shown. */
export function hiddenBecause(layer: MapLayer, lab: Lab): string | undefined {
  if (lab.sight() !== 'all' && !layer.isSensed) return 'Hidden in fog: no sensor tells it.';
  return layer.unavailable?.(lab);
}

export function createLayers<L extends MapLayer>(
  layers: readonly L[],
  lab: Lab,
  palette: Accessor<Palette>,
): readonly LiveLayer<L>[] {
  return layers.map((layer) => {
    const isShown = createMemo(
      () => lab.layers().has(layer.id) && hiddenBecause(layer, lab) === undefined,
    );
    return { ...layer, ...layer.create({ lab, palette, isShown }), isShown };
  });
}
