// The ghosts of the challenge, and where the attempt lost time.

import { createMemo } from 'solid-js';
import { isOver } from '../../lab/contest';
import type { Vec2 } from '../../lab/geometry';
import type { Contested, Trial } from '../../lab/slices';
import type { TraceMessage } from '../../net/protocol.gen';
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

/** A place between two samples, or the last one. */
function placeAt(places: readonly Vec2[], sample: number): Vec2 | undefined {
  const [from, to] = [places[Math.floor(sample)], places[Math.floor(sample) + 1]];
  if (!from || !to) return places.at(-1);
  const share = sample % 1;
  return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
}

const pathUntil = ({ bead_m }: TraceMessage, sample: number): readonly Vec2[] =>
  bead_m.slice(0, Math.floor(sample) + 1);

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
            const tool_m = placeAt(ghost.trace.tool_m, sample);
            const bead_m = placeAt(ghost.trace.bead_m, sample);
            if (!tool_m || !bead_m) return [];
            const { controller } = ghost;
            const path_m = pathUntil(ghost.trace, sample);
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
