// Says something, and says it again while nothing else is to be said: silence means that one is gone.

import { browserClock, type Clock } from './limiter';

export class Repeater<T> {
  private turn = 0;

  constructor(
    private readonly intervalMs: number,
    private readonly send: (value: T) => void,
    private readonly clock: Clock = browserClock,
  ) {}

  /** Now, and every interval from now on, until there is something else or nothing to say. */
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
