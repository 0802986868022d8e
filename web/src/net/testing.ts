// A clock for tests.

import type { Clock } from './limiter';

/** Moves only when the test advances it. Timers run in order of their times. */
export function manualClock(): Clock & { advance: (ms: number) => void } {
  let now = 0;
  let waiting: { at: number; action: () => void }[] = [];
  return {
    nowMs: () => now,
    later: (action, ms) => {
      waiting.push({ at: now + ms, action });
    },
    advance: (ms) => {
      const end = now + ms;
      for (;;) {
        waiting.sort((a, b) => a.at - b.at);
        const next = waiting[0];
        if (!next || next.at > end) break;
        waiting = waiting.slice(1);
        now = next.at;
        next.action();
      }
      now = end;
    },
  };
}
