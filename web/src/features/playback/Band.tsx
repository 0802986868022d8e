// The band of the time line: the colour of the controller that carried, hatched while the arm fetched.

import { For, createMemo, type JSX } from 'solid-js';
import type { TimeAxis } from '../../lab/timeAxis';
import type { Events, Trial } from '../../lab/slices';
import { LOOKS } from '../../ui/controllers';
import { stretches } from './stretches';

type Newest = Parameters<typeof stretches>[2] | undefined;

export const percent = (share: number): string => `${(100 * share).toFixed(3)}%`;

export function Band(props: {
  lab: Trial & Events;
  axis: TimeAxis;
  now_s: number;
  newest_s: number;
}): JSX.Element {
  const { lab, axis } = props;
  // The band changes only with the events and the ends of the axis. After a rewind it stays what it was.
  const newest = createMemo<Newest>(
    (before) => {
      const state = lab.state();
      return state && (state.tick >= state.newest_tick || !before) ? state : before;
    },
    undefined,
    { equals: (a, b) => a?.controller === b?.controller && a?.mode === b?.mode },
  );
  const parts = createMemo(() => {
    const [scene, state] = [lab.scene(), newest()];
    if (!scene || !state) return [];
    const found = stretches(lab.marks(), scene.scenario.controller, state);
    return found.map((stretch, index) => {
      const at = (tick: number): number =>
        Math.min(1, Math.max(0, axis.share(tick * scene.tick_s)));
      const next = found[index + 1];
      return { ...stretch, from: at(stretch.from_tick), to: next ? at(next.from_tick) : 1 };
    });
  });
  const cutBefore = (time_s: number): string => `inset(0 0 0 ${percent(axis.share(time_s))})`;
  return (
    <div class="band-line" aria-hidden="true">
      <For each={parts().filter(({ from, to }) => to > from)}>
        {({ controller, isFetching, from, to }) => (
          <span
            classList={{ fetch: isFetching }}
            style={{
              left: percent(from),
              width: percent(to - from),
              color: `var(--${controller ? LOOKS[controller].colour : 'line-strong'})`,
            }}
          />
        )}
      </For>
      <span class="not-run" style={{ 'clip-path': cutBefore(props.now_s) }} />
      <span class="beyond" style={{ 'clip-path': cutBefore(props.newest_s) }} />
    </div>
  );
}
