// The branches of a comparison as ghosts on the plan.

import { ghostAt, sampleAt } from '../../lab/comparison';
import { controllerLabel } from '../../lab/parameters';
import type { Compared, Trial } from '../../lab/slices';
import { drawGhosts, labelsBeside } from '../../plan/drawGhost';
import type { LayerContext, MapLayer } from '../../plan/layer';

export const GHOSTS_LAYER: MapLayer = {
  id: 'ghosts',
  label: 'Ghosts',
  swatch: ['m-rl', 'm-errt', 'm-attractor'],
  group: 'Motion',
  shownAtFirst: true,
  isUnclipped: true,
  unavailable: (lab) => (lab.panel() === 'recovery' ? 'Hidden while Recovery is open.' : undefined),
  create: ({ lab }: LayerContext<Compared & Trial>) => ({
    aboveWalls: () => {
      const comparison = lab.comparison.shown();
      if (!comparison) return undefined;
      const tick = lab.comparison.tick();
      return (ctx, { view, palette }) => {
        const ghosts = comparison.branches.flatMap((branch) => {
          const ghost = ghostAt(comparison, branch, tick);
          if (!ghost) return [];
          const places = branch.samples.map(([, , x_m, y_m]) => [x_m, y_m] as const);
          const now = sampleAt(comparison, branch, tick);
          const { controller } = branch;
          const label = controllerLabel(branch);
          const [path_m, ahead_m] = [places.slice(0, now + 1), places.slice(now)];
          return [{ ...ghost, controller, label, path_m, ahead_m }];
        });
        drawGhosts(ctx, view, palette, ghosts, labelsBeside(view, lab.goal()));
      };
    },
  }),
};
