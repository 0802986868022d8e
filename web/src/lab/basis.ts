// What the connection gives: the newest messages, and the ways to answer. All slices are made from it.

import type { Accessor } from 'solid-js';
import type { ClientMessage } from '../net/protocol.gen';
import type { Answer, Streamed } from './commands';
import type { Model } from './model';
import type { Place } from './places';

export interface Basis {
  /** The session of this page. */
  readonly session: string;
  readonly connection: Accessor<Model['connection']>;
  readonly hello: Accessor<Model['hello']>;
  readonly scene: Accessor<Model['scene']>;
  readonly state: Accessor<Model['state']>;
  /** Connected as the operator of a session that has not ended. */
  readonly canOperate: Accessor<boolean>;
  /** Sends a command. The answer comes after its effect is shown; a refusal is shown at the place. */
  send(at: Place, message: ClientMessage): Promise<Answer>;
  /** Sends what a hand does, which has no answer. */
  stream(message: Streamed): void;
  notify(place: Place, text: string): void;
}
