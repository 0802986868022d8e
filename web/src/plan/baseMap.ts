// The base map: layers that rarely change. The plan view draws it below the moving parts, the 3-D scene on its floor.

import { createMemo, type Accessor } from 'solid-js';
import type { Palette } from '../ui/palette';
import { drawFloor, drawGrid, drawOutlines, wallPath } from './drawMap';
import { drawMovedWalls } from './drawMovedWalls';
import type { BasePicture, Draw, LiveLayer } from './layer';
import { pxFromWorld, type View } from './transform';
import type { MovedWalls } from '../lab/movedWalls';
import type { Trial } from '../lab/slices';

export interface BaseMap extends BasePicture {
  readonly walls: Path2D;
  readonly belowWalls: readonly Draw<BasePicture>[];
  readonly aboveWalls: readonly Draw<BasePicture>[];
}

type Ctx = CanvasRenderingContext2D;

/** Clips to the workspace, because larger pictures would cover the numbers of the axes. */
export function drawClipped<P extends BasePicture>(ctx: Ctx, picture: P, draw: Draw<P>): void {
  const { view, scene } = picture;
  const rect = scene.workspace;
  const [left, top] = pxFromWorld(view, [rect.x_min_m, rect.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [rect.x_max_m, rect.y_min_m]);
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, right - left, bottom - top);
  ctx.clip();
  draw(ctx, picture);
  ctx.restore();
}

const clipped =
  (draw: Draw<BasePicture>): Draw<BasePicture> =>
  (ctx, picture) => {
    drawClipped(ctx, picture, draw);
  };

export function createBaseMap(
  lab: Trial,
  layers: readonly LiveLayer[],
  palette: Accessor<Palette>,
  view: Accessor<View | undefined>,
): Accessor<BaseMap | undefined> {
  const walls = createMemo(() => {
    const now = view();
    const scene = lab.scene();
    return now && scene ? wallPath(scene.walls, now) : undefined;
  });
  const part = (name: 'belowWalls' | 'aboveWalls') => {
    const drawings = layers.flatMap((layer) => {
      const drawing = layer[name]?.(view);
      return drawing ? [{ layer, drawing }] : [];
    });
    return (): Draw<BasePicture>[] =>
      drawings.flatMap(({ layer, drawing }) => {
        const draw = layer.isShown() ? drawing() : undefined;
        if (!draw) return [];
        return [layer.isUnclipped ? draw : clipped(draw)];
      });
  };
  const [belowWalls, aboveWalls] = [part('belowWalls'), part('aboveWalls')];
  return createMemo(() => {
    const [scene, now, wallsNow] = [lab.scene(), view(), walls()];
    if (!scene || !now || !wallsNow) return undefined;
    return {
      view: now,
      palette: palette(),
      scene,
      walls: wallsNow,
      belowWalls: belowWalls(),
      aboveWalls: aboveWalls(),
    };
  });
}

/** With the walls where they are now, if they move. */
export function paintBaseMap(ctx: Ctx, map: BaseMap, moved?: MovedWalls): void {
  const { view, palette, scene } = map;
  drawFloor(ctx, scene.workspace, view, palette);
  for (const draw of map.belowWalls) draw(ctx, map);
  drawGrid(ctx, scene.workspace, view, palette);
  if (moved) drawMovedWalls(ctx, scene.workspace, moved, view, palette);
  else drawOutlines(ctx, scene.workspace, map.walls, view, palette);
  for (const draw of map.aboveWalls) draw(ctx, map);
}
