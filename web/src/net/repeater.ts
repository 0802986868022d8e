// Sends a value and repeats it until the next one, because the server takes silence for a lost browser.

import { browserClock, type Clock } from './limiter';

export class Repeater<T> {
  private turn = 0;

  constructor(
    private readonly intervalMs: number,
    private readonly send: (value: T) => void,
    private readonly clock: Clock = browserClock,
  ) {}

  /** Sends now and at every interval, until the next value or a stop. */
  say(value: T): void {
    this.turn += 1;
    const { turn } = this;
    this.send(value);
    this.clock.later(() => {
      if (turn === this.turn) this.say(value);
    }, this.intervalMs);
  }

  stop(): void {
    this.turn += 1;
  }
}
