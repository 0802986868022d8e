// Announcements for screen readers. Pure.

import { Limiter } from '../net/limiter';
import type { LogLine, Model } from '../lab/model';

/** Smallest time between two announcements, because speech takes time. */
const EVERY_MS = 1000;

const ANNOUNCED_KINDS: ReadonlySet<LogLine['kind']> = new Set<LogLine['kind']>([
  'switch',
  'disturbance',
  'delivered',
  'lift_off',
  'stopped',
  'connection',
]);

/** The last announced line: its id and how often it happened. */
export interface Announced {
  readonly id: number;
  readonly count: number;
}

export function lastLine(log: readonly LogLine[]): Announced {
  const last = log.at(-1);
  return last ? { id: last.id, count: last.count } : { id: 0, count: 0 };
}

/** The newest important line after the last announced one. */
export function newsOf(log: readonly LogLine[], announced: Announced): string | undefined {
  const news = log.filter(
    ({ id, kind, count }) =>
      ANNOUNCED_KINDS.has(kind) &&
      (id > announced.id || (id === announced.id && count > announced.count)),
  );
  return news.at(-1)?.text;
}

/** Text for a change of role; undefined for the first role. */
export function roleWords(before: Model['hello'], now: Model['hello']): string | undefined {
  if (!before || !now || before.role === now.role) return undefined;
  return now.role === 'operator' ? 'You have control.' : 'You are watching.';
}

/** Announces the newest text, at most once per second. A repeated text is announced again. */
export function createAnnouncer(say: (text: string) => void): (text: string) => void {
  let last = '';
  const limiter = new Limiter<string>(EVERY_MS, (text) => {
    // Screen readers read the region when its text changes.
    last = text === last ? `${text}\u00a0` : text;
    say(last);
  });
  return (text) => {
    limiter.offer(text);
  };
}
