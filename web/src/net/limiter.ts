// Sends the newest of a stream of values, at most one per interval.

export interface Clock {
  nowMs(): number;
  later(action: () => void, ms: number): void;
}

export const browserClock: Clock = {
  nowMs: () => performance.now(),
  later: (action, ms) => {
    setTimeout(action, ms);
  },
};

export class Limiter<T> {
  private lastMs = -Infinity;
  private pending: { value: T } | undefined;
  private scheduled = false;

  constructor(
    private readonly intervalMs: number,
    private readonly send: (value: T) => void,
    private readonly clock: Clock = browserClock,
  ) {}

  offer(value: T): void {
    this.pending = { value };
    const waitMs = this.lastMs + this.intervalMs - this.clock.nowMs();
    if (waitMs <= 0) {
      this.flush();
    } else if (!this.scheduled) {
      this.scheduled = true;
      this.clock.later(() => {
        this.scheduled = false;
        this.flush();
      }, waitMs);
    }
  }

  /** Sends a waiting value now, so that the last value of a stream is not lost. */
  flush(): void {
    const pending = this.pending;
    if (!pending) return;
    this.pending = undefined;
    this.lastMs = this.clock.nowMs();
    this.send(pending.value);
  }
}
