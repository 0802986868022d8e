// The base map: layers that rarely change. The plan view draws it below the moving parts, the 3-D scene on its floor.

import { createMemo, type Accessor } from 'solid-js';
import { drawFloor, drawGrid, drawOutlines, wallPath } from './drawMap';
import { drawMovedWalls } from './drawMovedWalls';
import { type BasePicture, type Draw, type LiveLayer, shownParts } from './layer';
import { pxRect, type View } from './transform';
import type { MovedWalls } from '../lab/movedWalls';
import type { Trial } from '../lab/slices';
import type { Ctx } from './sheet';
import { palette } from '../ui/palette';

/** Floor and walls, with the layers between them. */
export interface Ground extends BasePicture {
  readonly walls: Path2D;
  /** The walls where they are now, if they move. */
  readonly moved: MovedWalls | undefined;
  readonly belowWalls: readonly Draw<BasePicture>[];
}

export interface BaseMap {
  readonly ground: Ground;
  readonly aboveWalls: readonly Draw<BasePicture>[];
}

/** Clips to the workspace, because larger pictures would cover the numbers of the axes. */
export const clipped =
  <P extends BasePicture>(draw: Draw<P>): Draw<P> =>
  (ctx, picture) => {
    ctx.save();
    ctx.beginPath();
    ctx.rect(...pxRect(picture.view, picture.scene.workspace));
    ctx.clip();
    draw(ctx, picture);
    ctx.restore();
  };

export function createBaseMap(
  lab: Pick<Trial, 'scene'>,
  layers: readonly LiveLayer[],
  view: Accessor<View | undefined>,
  moved?: Accessor<MovedWalls | undefined>,
): Accessor<BaseMap | undefined> {
  const walls = createMemo(() => {
    const now = view();
    const scene = lab.scene();
    return now && scene ? wallPath(scene.walls, now) : undefined;
  });
  const part = (name: 'belowWalls' | 'aboveWalls'): Draw<BasePicture>[] =>
    shownParts(layers, name).map(({ layer, drawing }) =>
      layer.isUnclipped ? drawing : clipped(drawing),
    );
  const ground = createMemo<Ground | undefined>(() => {
    const [scene, now, wallsNow] = [lab.scene(), view(), walls()];
    if (!scene || !now || !wallsNow) return undefined;
    const parts = { moved: moved?.(), belowWalls: part('belowWalls') };
    return { view: now, palette: palette(), scene, walls: wallsNow, ...parts };
  });
  return createMemo(() => {
    const now = ground();
    return now && { ground: now, aboveWalls: part('aboveWalls') };
  });
}

export function paintGround(ctx: Ctx, ground: Ground): void {
  const { view, palette, scene, walls, moved } = ground;
  drawFloor(ctx, scene.workspace, view, palette);
  for (const draw of ground.belowWalls) draw(ctx, ground);
  drawGrid(ctx, scene.workspace, view, palette);
  if (moved) drawMovedWalls(ctx, scene.workspace, moved, view, palette);
  else drawOutlines(ctx, scene.workspace, walls, view, palette);
}

export function paintAbove(ctx: Ctx, { ground, aboveWalls }: BaseMap): void {
  for (const draw of aboveWalls) draw(ctx, ground);
}
