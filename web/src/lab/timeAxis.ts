// The axis of the time line and of the plots above it.

import { createMemo, createSignal, type Accessor } from 'solid-js';
import { createChoice } from '../ui/storage';
import type { ComparisonMessage } from '../net/protocol.gen';
import { lastTick } from './comparison';
import { hasLanes } from './lanes';
import type { Compared, Contested, Trial } from './slices';

export const WINDOWS = [
  ['all', 'All'],
  ['60', '60 s'],
  ['10', '10 s'],
] as const;
export type WindowChoice = (typeof WINDOWS)[number][0];

export interface Span {
  readonly from_s: number;
  readonly to_s: number;
}

const LEAST_S = 10;
/** The axis grows in these steps, so that nothing on it moves in between. */
const ROUND = [1, 1.5, 2, 3, 4, 5, 6, 8] as const;
/** Of a window that goes with the time; a part of its width. */
const STEP = 0.25;

/** The next round length. */
function rounded(length_s: number): number {
  for (let unit_s = LEAST_S; ; unit_s *= 10) {
    const factor = ROUND.find((one) => one * unit_s >= length_s);
    if (factor !== undefined) return factor * unit_s;
  }
}

/** The ends of the axis. It shows the newest moment, or the present one if that is too far before it. */
export function shownSpan(
  choice: WindowChoice,
  oldest_s: number,
  newest_s: number,
  at_s: number,
): Span {
  if (choice === 'all') return { from_s: oldest_s, to_s: oldest_s + rounded(newest_s - oldest_s) };
  const width_s = Number(choice);
  const isNear = at_s >= newest_s - (1 - STEP) * width_s;
  const end_s = isNear ? newest_s : Math.min(newest_s, at_s + width_s / 2);
  const step_s = STEP * width_s;
  const to_s = Math.max(width_s, Math.ceil(end_s / step_s) * step_s);
  return { from_s: to_s - width_s, to_s };
}

export type TimeAxis = ReturnType<typeof createTimeAxis>;

/** The axis is that of `timed`, the comparison on the time line, if there is one. */
export function createTimeAxis(
  lab: Trial & Contested & Compared,
  timed: Accessor<ComparisonMessage | undefined>,
) {
  const [choice, choose] = createChoice(
    'window',
    WINDOWS.map(([id]) => id) as [WindowChoice, ...WindowChoice[]],
  );
  /** Time under a pointer. */
  const [pointed_s, point] = createSignal<number>();
  const rivals_s = createMemo(() =>
    Math.max(0, ...(lab.contest.ghosts()?.ghosts ?? []).map(({ total_s }) => total_s ?? 0)),
  );
  const span = createMemo(
    () => {
      const [state, tick_s] = [lab.state(), lab.scene()?.tick_s ?? 0];
      const compared = timed();
      if (compared) {
        const { tick, sim_time_s: from_s } = compared;
        return { from_s, to_s: from_s + rounded((lastTick(compared) - tick) * tick_s) };
      }
      const newest_s = Math.max(state?.newest_tick ?? 0, state?.tick ?? 0) * tick_s;
      // The choice is a control of the lanes.
      return shownSpan(
        hasLanes() ? choice() : 'all',
        (state?.oldest_tick ?? 0) * tick_s,
        Math.max(newest_s, rivals_s()),
        state?.sim_time_s ?? 0,
      );
    },
    undefined,
    { equals: (a, b) => a.from_s === b.from_s && a.to_s === b.to_s },
  );
  /** Where a time is on the axis: 0 at its beginning, 1 at its end, also beyond. */
  const share = (time_s: number): number =>
    (time_s - span().from_s) / (span().to_s - span().from_s);
  /** The time that is shown: the present, or that of the ghosts. */
  const now_s = (): number =>
    timed() ? lab.comparison.tick() * (lab.scene()?.tick_s ?? 0) : (lab.state()?.sim_time_s ?? 0);
  return { now_s, span, share, choice, choose, pointed_s, point };
}
