// The ghosts of the challenge, and where the attempt lost time.

import { createMemo } from 'solid-js';
import { isOver } from '../../lab/contest';
import { placeAfter } from '../../lab/geometry';
import type { Contested, Trial } from '../../lab/slices';
import { drawGhosts, labelsBeside } from '../../plan/drawGhost';
import type { LayerContext, MapLayer } from '../../plan/layer';
import { strokeCased } from '../../plan/marks';
import { circle } from '../../plan/shapes';
import { pxFromWorld } from '../../plan/transform';
import { seconds } from '../../ui/format';
import { ghostName } from '../../lab/challenges';

const LOSS_PX = 13;
/** The base map is drawn again for each of these. */
const FRAMES_PER_S = 10;

export const CHALLENGE_LAYER: MapLayer = {
  id: 'challenge',
  label: 'Challenge: ghosts',
  swatch: ['m-rl', 'm-errt', 'm-attractor', 'm-you'],
  group: 'Motion',
  shownAtFirst: true,
  create: ({ lab, isShown }: LayerContext<Contested & Trial>) => {
    const { contest } = lab;
    const frame = createMemo(() =>
      isShown() && contest.name() !== undefined
        ? Math.floor((lab.state()?.sim_time_s ?? 0) * FRAMES_PER_S)
        : 0,
    );
    return {
      aboveWalls: () => {
        if (contest.name() === undefined) return undefined;
        const { ghosts = [], sample_s = 1 } = contest.ghosts() ?? {};
        const sample = frame() / FRAMES_PER_S / sample_s;
        const loss = isOver(contest.attempt()) ? contest.report()?.loss : undefined;
        const goal = lab.goal();
        return (ctx, { view, palette }) => {
          const labels = labelsBeside(view, goal);
          const shown = ghosts.flatMap((ghost) => {
            const tool_m = placeAfter(ghost.trace.tool_m, sample);
            const bead_m = placeAfter(ghost.trace.bead_m, sample);
            if (!tool_m || !bead_m) return [];
            const { controller } = ghost;
            const path_m = ghost.trace.bead_m.slice(0, Math.floor(sample) + 1);
            return [{ controller, label: ghostName(ghost), path_m, tool_m, bead_m }];
          });
          drawGhosts(ctx, view, palette, shown, labels);
          if (!loss) return;
          const at = pxFromWorld(view, loss.place_m);
          circle(ctx, at, LOSS_PX);
          strokeCased(ctx, palette, { colour: palette['m-danger'], width_px: 2.2 });
          labels.draw(ctx, palette, `lost ${seconds(loss.lost_s)} here`, at, LOSS_PX + 6);
        };
      },
    };
  },
};
