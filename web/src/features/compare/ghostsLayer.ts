import type { LayerContext, MapLayer } from '../../plan/layer';
import { drawGhosts } from './drawGhosts';
import type { Compared } from '../../lab/slices';

export const GHOSTS_LAYER: MapLayer = {
  id: 'ghosts',
  label: 'Ghosts',
  swatch: ['rl', 'errt', 'attractor'],
  group: 'Motion',
  shownAtFirst: true,
  isUnclipped: true,
  create: ({ lab }: LayerContext<Compared>) => ({
    aboveWalls: () => {
      const comparison = lab.comparison.shown();
      if (!comparison) return undefined;
      const tick = lab.comparison.tick();
      return (ctx, { view, palette }) => {
        drawGhosts(ctx, view, palette, comparison, tick);
      };
    },
  }),
};
