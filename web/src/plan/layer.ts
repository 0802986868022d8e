// Layers of the map. A feature exports its layers; `app` lists them in drawing order.

import { createMemo, type Accessor, type JSX } from 'solid-js';
import type { History } from '../lab/history';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import type { Vec2 } from '../lab/geometry';
import type { View } from './transform';
import type { Lab } from '../lab/slices';
import type { Ctx } from './sheet';
import type { Palette } from '../ui/palette';

/** Headings of the menu, in its order. */
export const LAYER_GROUPS = ['Motion', 'Camera', 'RL', 'ERRT', 'Attractor', 'Arm', 'Map'] as const;

export interface BasePicture {
  readonly view: View;
  readonly palette: Palette;
  readonly scene: SceneMessage;
  /** What no wall at rest covers, to be filled by the rule `evenodd`. */
  readonly free: Path2D;
}

export interface MovingPicture extends BasePicture {
  readonly state: StateMessage;
  readonly history: History;
}

export type Draw<P extends BasePicture> = (ctx: Ctx, picture: P) => void;

/** A square picture with its middle below the tool, around the origin of the view. It moves with the tool. */
export interface UnderTool {
  readonly halfSide_m: number;
  readonly draw: (ctx: Ctx, view: View, palette: Palette) => void;
}

interface Drawings {
  readonly belowWalls: Draw<BasePicture>;
  readonly aboveWalls: Draw<BasePicture>;
  /** Drawn with every state, above the base map and below goal, tool and bead. */
  readonly moving: Draw<MovingPicture>;
  /** Drawn below those. */
  readonly underTool: UnderTool;
}

/** They are read only while the layer is shown, and are undefined while there is nothing to draw. */
type DrawnParts = {
  readonly [Part in keyof Drawings]?: Accessor<Drawings[Part] | undefined>;
};

/** What a press on the map does in place of setting the goal. */
export interface Press {
  /** What the map shows: stands before *click* or *tap*. */
  readonly shown: string;
  /** Where, and what for: goes on after it. */
  readonly words: string;
  /** Undefined for a place where it sets the goal. */
  readonly at: (place: Vec2) => (() => void) | undefined;
}

export interface LayerParts extends DrawnParts {
  readonly press?: Accessor<Press | undefined>;
  readonly legend?: () => JSX.Element;
}

/** A part that draws something while it is there. */
export function drawn<P extends BasePicture, T>(
  thing: Accessor<T | undefined>,
  draw: (ctx: Ctx, picture: P, thing: T) => void,
): Accessor<Draw<P> | undefined> {
  return () => {
    const now = thing();
    return now === undefined
      ? undefined
      : (ctx, picture) => {
          draw(ctx, picture, now);
        };
  };
}

export interface LayerContext<L = Lab> {
  readonly lab: L;
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
  /** `aboveWalls` may draw outside the tray. */
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

/** What the shown layers have for a part of a picture, with its layer. */
export function shownParts<Part extends keyof Drawings>(layers: readonly LiveLayer[], part: Part) {
  return layers.flatMap((layer) => {
    const { [part]: read }: DrawnParts = layer;
    const drawing = layer.isShown() ? read?.() : undefined;
    return drawing ? [{ layer, drawing }] : [];
  });
}

/** What a press does now: that of the first shown layer that has one. */
export const shownPress = (layers: readonly LiveLayer[]): Press | undefined =>
  layers.flatMap((layer) => (layer.isShown() ? (layer.press?.() ?? []) : []))[0];

export function createLayers<L extends MapLayer>(
  layers: readonly L[],
  lab: Lab,
): readonly LiveLayer<L>[] {
  return layers.map((layer) => {
    const isShown = createMemo(
      () => lab.layers().has(layer.id) && hiddenBecause(layer, lab) === undefined,
    );
    return { ...layer, ...layer.create({ lab, isShown }), isShown };
  });
}
