// The layers of the planner's camera data.

import { createMemo } from 'solid-js';
import type { BlocksLayer } from '../../net/protocol.gen';
import type { LayerContext, MapLayer } from '../../plan/layer';
import type { View } from '../../plan/transform';
import type { Palette } from '../../ui/palette';
import { createSeen, drawBlocks, drawRectangles, drawSeen } from './drawObserved';
import type { Pictures } from '../../lab/slices';

export const SEEN_LAYER: MapLayer = {
  id: 'seen',
  isSensed: true,
  label: 'Seen so far',
  swatch: ['unseen', 'sensed'],
  group: 'Camera',
  isUnclipped: true,
  create: ({ lab, palette, isShown }: LayerContext<Pictures>) => {
    const seen = createMemo(() => {
      const message = isShown() ? lab.obstacleMap() : undefined;
      return message && createSeen(message, palette());
    });
    return {
      aboveWalls: () => () => {
        const now = seen();
        return (
          now &&
          ((ctx, { view }) => {
            drawSeen(ctx, view, now);
          })
        );
      },
    };
  },
};

function ofBlocks(
  id: string,
  label: string,
  swatch: MapLayer['swatch'],
  draw: (ctx: CanvasRenderingContext2D, view: View, palette: Palette, layer: BlocksLayer) => void,
): MapLayer {
  return {
    id,
    label,
    swatch,
    group: 'Camera',
    isSensed: true,
    create: ({ lab }: LayerContext<Pictures>) => ({
      aboveWalls: () => () => {
        const overlay = lab.overlay();
        return (
          overlay &&
          ((ctx, { view, palette }) => {
            draw(ctx, view, palette, overlay.blocks);
          })
        );
      },
    }),
  };
}

export const BLOCKS_LAYER = ofBlocks('blocks', 'Quadtree', ['muted', 'sensed'], drawBlocks);
export const RECTANGLES_LAYER = ofBlocks('rectangles', 'Rectangles', ['error-x'], drawRectangles);
