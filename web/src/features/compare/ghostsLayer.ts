// The branches of a comparison as ghosts on the plan.

import { ghostAt } from '../../lab/comparison';
import { controllerLabel } from '../../lab/parameters';
import type { Compared } from '../../lab/slices';
import { drawGhost } from '../../plan/drawGhost';
import type { LayerContext, MapLayer } from '../../plan/layer';

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
        for (const branch of comparison.branches) {
          const ghost = ghostAt(comparison, branch, tick);
          if (!ghost) continue;
          drawGhost(ctx, view, palette, {
            ...ghost,
            colour: palette[branch.controller],
            label: controllerLabel(branch),
            path_m: branch.samples.map(([, , x_m, y_m]) => [x_m, y_m] as const),
          });
        }
      };
    },
  }),
};
