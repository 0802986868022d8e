// The base map: layers that rarely change. The plan view draws it below the moving parts, the 3-D scene on its floor.

import {
  createEffect,
  createMemo,
  createSignal,
  onCleanup,
  untrack,
  type Accessor,
} from 'solid-js';
import { drawFloor } from './drawMap';
import { drawMovedWalls } from './drawMovedWalls';
import { type BasePicture, type Draw, type LiveLayer, shownParts } from './layer';
import { Relief } from './relief';
import { freePath, trayPath } from './tray';
import type { View } from './transform';
import type { MovedWalls } from '../lab/movedWalls';
import type { Trial } from '../lab/slices';
import type { Ctx } from './sheet';
import { palette } from '../ui/palette';

/** The relief is painted again when the view has been still for this time. */
const STILL_MS = 140;

/** Floor and walls, with the layers between them. */
export interface Ground extends BasePicture {
  readonly relief: Relief;
  /** The view does not change now. */
  readonly isStill: boolean;
  /** The walls where they are now, if they move. */
  readonly moved: MovedWalls | undefined;
  readonly belowWalls: readonly Draw<BasePicture>[];
}

export interface BaseMap {
  readonly ground: Ground;
  readonly aboveWalls: readonly Draw<BasePicture>[];
}

/** Clips to the tray: what reaches beyond the workspace ends with its frame. */
export const clipped =
  <P extends BasePicture>(draw: Draw<P>): Draw<P> =>
  (ctx, picture) => {
    ctx.save();
    ctx.clip(trayPath(picture.scene.workspace, picture.view));
    draw(ctx, picture);
    ctx.restore();
  };

/** The view once it has been still; the first one at once. */
function createStill(view: Accessor<View | undefined>): Accessor<View | undefined> {
  const [still, setStill] = createSignal(untrack(view));
  createEffect(() => {
    const now = view();
    if (untrack(still) === undefined) {
      setStill(now);
      return;
    }
    const timer = setTimeout(() => setStill(now), STILL_MS);
    onCleanup(() => clearTimeout(timer));
  });
  return still;
}

export function createBaseMap(
  lab: Pick<Trial, 'scene'>,
  layers: readonly LiveLayer[],
  view: Accessor<View | undefined>,
  moved?: Accessor<MovedWalls | undefined>,
): Accessor<BaseMap | undefined> {
  const tray = createMemo(
    () => {
      const scene = lab.scene();
      return scene && { workspace: scene.workspace, walls: scene.walls };
    },
    undefined,
    // Other parameters leave the tray as it is.
    { equals: (a, b) => JSON.stringify(a) === JSON.stringify(b) },
  );
  const relief = createMemo(() => {
    const now = tray();
    return now && new Relief(now, palette());
  });
  const free = createMemo(() => {
    const [now, onto] = [tray(), view()];
    return now && onto && freePath(now, onto);
  });
  const still = createStill(view);
  const part = (name: 'belowWalls' | 'aboveWalls'): Draw<BasePicture>[] =>
    shownParts(layers, name).map(({ layer, drawing }) =>
      layer.isUnclipped ? drawing : clipped(drawing),
    );
  const ground = createMemo<Ground | undefined>(() => {
    const [scene, now, reliefNow, freeNow] = [lab.scene(), view(), relief(), free()];
    if (!scene || !now || !reliefNow || !freeNow) return undefined;
    const parts = { moved: moved?.(), belowWalls: part('belowWalls') };
    const walls = { relief: reliefNow, free: freeNow, isStill: still() === now };
    return { view: now, palette: palette(), scene, ...walls, ...parts };
  });
  return createMemo(() => {
    const now = ground();
    return now && { ground: now, aboveWalls: part('aboveWalls') };
  });
}

export function paintGround(ctx: Ctx, ground: Ground): void {
  const { view, palette, scene, relief, moved, isStill } = ground;
  drawFloor(ctx, scene.workspace, view, palette);
  for (const draw of ground.belowWalls) draw(ctx, ground);
  if (moved) drawMovedWalls(ctx, ground, moved, relief, isStill);
  else relief.draw(ctx, view, isStill);
}

export function paintAbove(ctx: Ctx, { ground, aboveWalls }: BaseMap): void {
  for (const draw of aboveWalls) draw(ctx, ground);
}
