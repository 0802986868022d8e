// The layers of the planner's camera data.

import { createMemo } from 'solid-js';
import { drawn, type LayerContext, type MapLayer } from '../../plan/layer';
import { createSeen, drawBlocks, drawRectangles, drawSeen } from './drawObserved';
import type { Pictures } from '../../lab/slices';
import { palette } from '../../ui/palette';

const OF_CAMERA = { group: 'Camera', isSensed: true } as const;

export const SEEN_LAYER: MapLayer = {
  ...OF_CAMERA,
  id: 'seen',
  label: 'Seen so far',
  swatch: ['unseen', 'sensed'],
  create: ({ lab, isShown }: LayerContext<Pictures>) => {
    const seen = createMemo(() => {
      const message = isShown() ? lab.obstacleMap() : undefined;
      return message && createSeen(message, palette());
    });
    return { aboveWalls: drawn(seen, drawSeen) };
  },
};

export const BLOCKS_LAYER: MapLayer = {
  ...OF_CAMERA,
  id: 'blocks',
  label: 'Quadtree',
  swatch: ['sensed'],
  create: ({ lab }: LayerContext<Pictures>) => ({ aboveWalls: drawn(lab.overlay, drawBlocks) }),
};

export const RECTANGLES_LAYER: MapLayer = {
  ...OF_CAMERA,
  id: 'rectangles',
  label: 'Rectangles',
  swatch: ['sensed'],
  create: ({ lab }: LayerContext<Pictures>) => ({ aboveWalls: drawn(lab.overlay, drawRectangles) }),
};
