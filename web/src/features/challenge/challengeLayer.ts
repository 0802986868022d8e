// The ghosts of the challenge, and where the attempt lost time.

import { createMemo } from 'solid-js';
import { isOver } from '../../lab/contest';
import { distance, type Vec2 } from '../../lab/geometry';
import type { Contested, Trial } from '../../lab/slices';
import type { TraceMessage } from '../../net/protocol.gen';
import { drawGhost, drawLabel } from '../../plan/drawGhost';
import type { LayerContext, MapLayer } from '../../plan/layer';
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

/** Ghosts nearer to each other share a label. */
const LABEL_PX = 60;
const LABEL_MOST = 12;
const short = (name: string): string =>
  name.length > LABEL_MOST ? `${name.slice(0, LABEL_MOST - 1)}…` : name;

const pathUntil = ({ bead_m }: TraceMessage, sample: number): readonly Vec2[] =>
  bead_m.slice(0, Math.floor(sample) + 1);

export const CHALLENGE_LAYER: MapLayer = {
  id: 'challenge',
  label: 'Challenge: ghosts',
  swatch: ['rl', 'errt', 'attractor', 'you'],
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
        return (ctx, { view, palette }) => {
          const labelled: Vec2[] = [];
          for (const ghost of ghosts) {
            const tool_m = placeAt(ghost.trace.tool_m, sample);
            const bead_m = placeAt(ghost.trace.bead_m, sample);
            if (!tool_m || !bead_m) continue;
            const at = pxFromWorld(view, tool_m);
            // Labels over each other cannot be read: the colours tell the ghosts apart.
            const isFree = labelled.every((other) => distance(other, at) > LABEL_PX);
            if (isFree) labelled.push(at);
            const colour = palette[ghost.controller];
            const label = isFree ? short(ghostName(ghost)) : '';
            const path_m = pathUntil(ghost.trace, sample);
            drawGhost(ctx, view, palette, { colour, label, path_m, tool_m, bead_m });
          }
          if (!loss) return;
          const [x, y] = pxFromWorld(view, loss.place_m);
          ctx.save();
          ctx.strokeStyle = palette.danger;
          ctx.fillStyle = palette.danger;
          ctx.lineWidth = 2;
          ctx.beginPath();
          ctx.arc(x, y, LOSS_PX, 0, 2 * Math.PI);
          ctx.stroke();
          // Above the ring, clear of bead and magnet.
          const label = `lost ${seconds(loss.lost_s)} here`;
          drawLabel(ctx, palette, label, [x + LOSS_PX + 4, y - LOSS_PX - 6]);
          ctx.restore();
        };
      },
    };
  },
};
