// Sends a value and repeats it until the next one, because the server takes silence for a lost browser.

export class Repeater<T> {
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(
    private readonly intervalMs: number,
    private readonly send: (value: T) => void,
  ) {}

  /** Sends now and at every interval, until the next value or a stop. */
  say(value: T): void {
    this.stop();
    this.send(value);
    this.timer = setInterval(() => this.send(value), this.intervalMs);
  }

  stop(): void {
    clearInterval(this.timer);
  }
}
