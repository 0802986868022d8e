// A board that is read again and again, with the entries that are new.

import { createEffect, createSignal, on, onCleanup, type Accessor } from 'solid-js';
import { createPoll } from './poll';
import type { ChallengeReport } from '../../net/protocol.gen';
import { Refusal } from '../../net/requests';
import { added, keyOf } from './entries';

const POLL_MS = 3000;
/** A wrong name stays wrong. */
const REFUSED_MS = 600_000;
const NOT_FOUND = 404;
const NEW_MS = 10_000;

export interface LiveBoard {
  readonly name: string;
  readonly report: Accessor<ChallengeReport | undefined>;
  /** Why the report is missing or out of date. */
  readonly error: Accessor<string | undefined>;
  /** Keys of the entries that are new. */
  readonly fresh: Accessor<ReadonlySet<string>>;
}

/** Reads the board of a challenge until the owner is disposed of. */
export function createBoard(name: string): LiveBoard {
  const path = `/api/challenges/${encodeURIComponent(name)}`;
  const isWrong = (reason: unknown): boolean =>
    reason instanceof Refusal && reason.status === NOT_FOUND;
  const { data, error } = createPoll<ChallengeReport>(path, (reason) =>
    isWrong(reason) ? REFUSED_MS : POLL_MS,
  );
  const [fresh, setFresh] = createSignal<ReadonlySet<string>>(new Set());
  const timers = new Set<ReturnType<typeof setTimeout>>();
  createEffect(
    on(data, (now, before) => {
      // The first board is not new.
      if (!now || !before) return;
      const keys = added(now.board, before.board).map(keyOf);
      if (keys.length === 0) return;
      setFresh((known) => new Set([...known, ...keys]));
      const timer = setTimeout(() => {
        timers.delete(timer);
        setFresh((known) => new Set([...known].filter((key) => !keys.includes(key))));
      }, NEW_MS);
      timers.add(timer);
    }),
  );
  onCleanup(() => {
    timers.forEach(clearTimeout);
  });
  return { name, report: data, error, fresh };
}
