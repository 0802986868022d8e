// A clock for tests.

import type { Clock } from './limiter';

/** Stands still unless it is advanced; what comes due on the way happens in its order. */
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
