// Sends the newest of a stream of values, at most one per interval.

export class Limiter<T> {
  private lastMs = -Infinity;
  private pending: { value: T } | undefined;
  private scheduled = false;

  constructor(
    private readonly intervalMs: number,
    private readonly send: (value: T) => void,
  ) {}

  offer(value: T): void {
    this.pending = { value };
    const waitMs = this.lastMs + this.intervalMs - performance.now();
    if (waitMs <= 0) {
      this.flush();
    } else if (!this.scheduled) {
      this.scheduled = true;
      setTimeout(() => {
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
    this.lastMs = performance.now();
    this.send(pending.value);
  }
}
