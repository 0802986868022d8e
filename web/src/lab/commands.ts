// Commands that wait for the server's answer.

import type { Numbered } from '../net/connection';
import type { ClientMessage, RefusedMessage, ServerMessage } from '../net/protocol.gen';
import type { Place } from './places';

export type Answer =
  /** Its effect is shown. */
  | { readonly kind: 'done'; readonly trial: number }
  /** Nothing changed. */
  | { readonly kind: 'refused'; readonly refusal: RefusedMessage }
  /** The connection was lost: it may have been carried out. */
  | { readonly kind: 'unknown' };

export type AnswerMessage = Extract<ServerMessage, { type: 'done' | 'refused' }>;

/** Messages that are repeated or follow a hand. They carry no id and have no answer. */
export type Streamed = Extract<
  ClientMessage,
  { type: 'drag' | 'release' | 'steer' | 'drive_robot' }
>;

interface Waiting {
  readonly at: Place;
  readonly settle: (answer: Answer) => void;
}

export class Commands {
  private readonly waiting = new Map<number, Waiting>();
  private last = 0;

  /** `transmit` returns whether the message was sent. */
  constructor(private readonly transmit: (message: Numbered) => boolean) {}

  send(at: Place, message: ClientMessage): Promise<Answer> {
    this.last += 1;
    const id = this.last;
    if (!this.transmit({ ...message, id })) return Promise.resolve({ kind: 'unknown' });
    return new Promise((settle) => this.waiting.set(id, { at, settle }));
  }

  /** Where the message of this id was sent from. */
  placeOf(id: number): Place | undefined {
    return this.waiting.get(id)?.at;
  }

  answer(message: AnswerMessage): void {
    const one = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    one?.settle(
      message.type === 'done'
        ? { kind: 'done', trial: message.trial }
        : { kind: 'refused', refusal: message },
    );
  }

  lose(): void {
    const all = [...this.waiting.values()];
    this.waiting.clear();
    for (const { settle } of all) settle({ kind: 'unknown' });
  }
}
