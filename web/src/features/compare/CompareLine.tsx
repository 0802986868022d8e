// The comparison on the time line: a row for each controller, its outcome at its end, and the slider of the ghosts.

import { GitCompare } from 'lucide';
import { For, createMemo, createSignal, onMount, type JSX } from 'solid-js';
import { lastTick } from '../../lab/comparison';
import { controllerLabel } from '../../lab/parameters';
import type { Compared } from '../../lab/slices';
import type { TimeAxis } from '../../lab/timeAxis';
import type { ComparisonMessage } from '../../net/protocol.gen';
import { LOOKS } from '../../ui/controllers';
import { clock } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { onSize } from '../../ui/size';
import { endTick, ending } from './ending';
import { GhostSlider } from './GhostSlider';
import './compare.css';

/** Marks of outcomes do not cover each other. */
const GAP_PX = 24;

export default function CompareLine(props: {
  lab: Compared;
  comparison: ComparisonMessage;
  axis: TimeAxis;
  tick_s: number;
}): JSX.Element {
  let bar!: HTMLDivElement;
  const [width_px, setWidth] = createSignal(0);
  onMount(() => {
    onSize(bar, ({ width }) => setWidth(width));
  });
  const share = (tick: number): number => props.axis.share(tick * props.tick_s);
  const percent = (tick: number): string => `${(100 * share(tick)).toFixed(3)}%`;
  const rows = createMemo(() =>
    props.comparison.branches.map((branch) => ({
      branch,
      color: `var(--${LOOKS[branch.controller].colour})`,
      end: endTick(props.comparison, branch),
    })),
  );
  /** The last one stands at its end, earlier ones at least a gap before the next. */
  const outcomes = createMemo(() => {
    let free_px = Infinity;
    return rows()
      .filter(({ branch }) => branch.done)
      .sort((a, b) => b.end - a.end)
      .map(({ branch, color, end }) => {
        const px = Math.min(width_px() * share(end), free_px);
        free_px = px - GAP_PX;
        const [word, icon] = ending(props.comparison, branch);
        const after = clock((end - props.comparison.tick) * props.tick_s);
        return { px, color, icon, name: `${controllerLabel(branch)}: ${word} after ${after}` };
      });
  });
  return (
    <div class="track">
      <div ref={bar} class="event-marks">
        <span class="mark same-moment" title="The same moment">
          <Icon of={GitCompare} />
        </span>
        <For each={outcomes()}>
          {({ px, color, icon, name }) => (
            <span
              class="mark"
              role="img"
              aria-label={name}
              title={name}
              style={{ left: `${px}px`, color }}
            >
              <Icon of={icon} />
            </span>
          )}
        </For>
      </div>
      <div class="branch-rows" aria-hidden="true">
        <For each={rows()}>
          {({ color, end }) => <span style={{ width: percent(end), background: color }} />}
        </For>
      </div>
      <GhostSlider
        lab={props.lab}
        comparison={props.comparison}
        tick_s={props.tick_s}
        style={{
          left: 'calc(var(--thumb) / -2)',
          width: `calc(${percent(lastTick(props.comparison))} + var(--thumb))`,
        }}
      />
    </div>
  );
}
