// A comparison: one moment continued under several controllers. All branches are shown at the same time.

import { createEffect, createMemo, createSignal, on, onCleanup, type Accessor } from 'solid-js';
import type { Branch, ComparisonMessage } from '../net/protocol.gen';
import { distance, type Vec2 } from './geometry';

/** Simulated seconds per second while ghosts play. */
const PLAY_SPEED = 2;

export interface Ghost {
  readonly tool_m: Vec2;
  readonly bead_m: Vec2;
}

/** Tick of the last sample of the longest branch. */
export function lastTick({ tick, ticks_a_sample, branches }: ComparisonMessage): number {
  return tick + ticks_a_sample * Math.max(0, ...branches.map(({ samples }) => samples.length));
}

/** A branch at a tick, or at its end if it ended earlier. Undefined before its first sample. */
/** Index of the sample of a tick, or of the nearest one. */
export function sampleAt(comparison: ComparisonMessage, branch: Branch, tick: number): number {
  const index = Math.round((tick - comparison.tick) / comparison.ticks_a_sample) - 1;
  return Math.min(Math.max(0, index), branch.samples.length - 1);
}

export function ghostAt(
  comparison: ComparisonMessage,
  branch: Branch,
  tick: number,
): Ghost | undefined {
  const sample = branch.samples[sampleAt(comparison, branch, tick)];
  return sample && { tool_m: [sample[0], sample[1]], bead_m: [sample[2], sample[3]] };
}

/** Distances between tool and bead in metres, one per sample. */
export function errors_m(branch: Branch): number[] {
  return branch.samples.map(([toolX, toolY, beadX, beadY]) =>
    distance([toolX, toolY], [beadX, beadY]),
  );
}

/** Whether the first is a later stage of the same comparison as the second. */
function continues(now: ComparisonMessage, before: ComparisonMessage): boolean {
  return now.trial === before.trial && now.tick === before.tick && before.running;
}

export type Comparison = ReturnType<typeof createComparison>;

export function createComparison(
  newest: Accessor<ComparisonMessage | undefined>,
  tick_s: Accessor<number>,
) {
  const [hidden, setHidden] = createSignal<Pick<ComparisonMessage, 'trial' | 'tick'>>();
  const [tick, setTick] = createSignal(0);
  const [playing, setPlaying] = createSignal(false);
  const comparison = createMemo(() => {
    const [now, cleared] = [newest(), hidden()];
    // The server sends it repeatedly while it runs.
    return now?.trial === cleared?.trial && now?.tick === cleared?.tick ? undefined : now;
  });
  let frame = 0;

  const pause = (): void => {
    cancelAnimationFrame(frame);
    setPlaying(false);
  };
  const play = (): void => {
    const now = comparison();
    if (!now || playing()) return;
    if (tick() >= lastTick(now)) setTick(now.tick);
    setPlaying(true);
    let before_ms = performance.now();
    const step = (now_ms: number): void => {
      const shown = comparison();
      if (!shown) return;
      const next = tick() + ((now_ms - before_ms) / 1000 / tick_s()) * PLAY_SPEED;
      before_ms = now_ms;
      setTick(Math.min(lastTick(shown), next));
      if (next < lastTick(shown)) frame = requestAnimationFrame(step);
      else setPlaying(false);
    };
    frame = requestAnimationFrame(step);
  };

  createEffect(
    on(comparison, (now, before) => {
      if (!now) pause();
      // They grow as they are computed, unless someone is looking at an earlier time.
      else if (!before || !continues(now, before) || tick() === lastTick(before)) {
        pause();
        setTick(lastTick(now));
      }
    }),
  );
  onCleanup(pause);

  return {
    shown: comparison,
    /** The time at which the branches are shown. */
    tick,
    playing,
    look: (to: number) => {
      pause();
      setTick(to);
    },
    play,
    pause,
    /** The branches of this moment, until the next comparison is requested. */
    hide: () => setHidden(newest()),
    show: () => setHidden(undefined),
  };
}
