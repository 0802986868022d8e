// A board that is read again and again, with the entries that are new.

import { createEffect, createSignal, on } from 'solid-js';
import { challengePath } from '../../lab/challenges';
import { createPoll } from './poll';
import type { ChallengeReport } from '../../net/protocol.gen';
import { added, keyOf } from './entries';

const POLL_MS = 3000;
const NEW_MS = 10_000;

/** Reads the board of a challenge until the owner is disposed of. */
export function createBoard(name: string) {
  const poll = createPoll<ChallengeReport>(challengePath(name), POLL_MS);
  const [fresh, setFresh] = createSignal<ReadonlySet<string>>(new Set());
  createEffect(
    on(poll.data, (now, before) => {
      // The first board is not new.
      if (!now || !before) return;
      const keys = new Set(added(now.board, before.board).map(keyOf));
      if (keys.size === 0) return;
      setFresh((known) => new Set([...known, ...keys]));
      setTimeout(
        () => setFresh((known) => new Set([...known].filter((key) => !keys.has(key)))),
        NEW_MS,
      );
    }),
  );
  return {
    ...poll,
    /** Keys of the entries that are new. */
    fresh,
  };
}
