import type { MapLayer } from '../../plan/layer';
import { drawGhosts } from './drawGhosts';

export const GHOSTS_LAYER: MapLayer = {
  id: 'ghosts',
  label: 'Ghosts',
  group: 'Motion',
  shownAtFirst: true,
  isUnclipped: true,
  create: ({ lab }) => ({
    aboveWalls: () => () => {
      const comparison = lab.ghosts.comparison();
      if (!comparison) return undefined;
      const tick = lab.ghosts.tick();
      return (ctx, { view, palette }) => {
        drawGhosts(ctx, view, palette, comparison, tick);
      };
    },
  }),
};
