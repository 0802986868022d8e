// Drives a paused session by steps. What a test sees then does not depend on the speed of the machine.

import type { Page } from '@playwright/test';
import { Messages } from './messages';
import { until } from './wait';
import type { ClientMessage } from './wire';

/** At the machine's own speed a second of the simulation takes a few hundredths of a second; a busy machine is slower. */
const STEP_MS = 60_000;
/** One second of the simulation. */
export const SECOND_TICKS = 125;
/** Enough for one control step. */
export const CONTROL_STEP_TICKS = 32;
/** A condition that is not reached within this time of the simulation will not be reached. */
const MOST_TICKS = 240 * SECOND_TICKS;

declare global {
  interface Window {
    ferrySocket: WebSocket;
  }
}

/** Runs in the page before its scripts: keeps its socket, so that a test can send a command as the page does. */
export function keepSocket() {
  const Native = window.WebSocket;
  window.WebSocket = class extends Native {
    constructor(...all: ConstructorParameters<typeof WebSocket>) {
      super(...all);
      window.ferrySocket = this;
    }
  };
}

export class Stepper extends Messages {
  constructor(readonly page: Page) {
    super(page);
  }

  /** Waits two frames. After that the page shows all messages that it has received. */
  drawn() {
    return this.page.evaluate(
      () =>
        new Promise<void>((done) => {
          requestAnimationFrame(() =>
            requestAnimationFrame(() => {
              done();
            }),
          );
        }),
    );
  }

  /** Sends a command over the page's socket, without its controls. */
  send(command: ClientMessage) {
    return this.page.evaluate((text) => {
      window.ferrySocket.send(text);
    }, JSON.stringify(command));
  }

  private async advance(ticks: number) {
    const end = this.state.tick + ticks;
    await this.send({ type: 'step', ticks });
    await until(`tick ${end}`, () => this.state.tick === end, STEP_MS);
  }

  /** Advances a paused session, and waits until the page shows its state. The speed of this machine does not matter. */
  async step(ticks: number) {
    await this.advance(ticks);
    await this.drawn();
  }

  /** Advances a paused session by `ticks` at a time until `probe` holds. */
  async stepUntil(what: string, probe: () => unknown, ticks = SECOND_TICKS) {
    const { tick } = this.state;
    while (!(await probe())) {
      if (this.state.tick - tick > MOST_TICKS) throw new Error(`not reached: ${what}`);
      await this.advance(ticks);
    }
    await this.drawn();
  }
}
