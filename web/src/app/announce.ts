// What the page says aloud to those who do not see it. Pure.

import { type Clock, Limiter } from '../net/limiter';
import type { LogLine, Model } from '../lab/model';

/** At most so often: speech takes time. */
const EVERY_MS = 1000;

const SPOKEN: ReadonlySet<LogLine['kind']> = new Set<LogLine['kind']>([
  'switch',
  'disturbance',
  'delivered',
  'lift_off',
  'stopped',
  'connection',
]);

/** What was heard already: a line's id and how often it happened. */
export interface Heard {
  readonly id: number;
  readonly count: number;
}

export function heardOf(log: readonly LogLine[]): Heard {
  const last = log.at(-1);
  return last ? { id: last.id, count: last.count } : { id: 0, count: 0 };
}

/** The newest line worth saying that came after `heard`. */
export function newsOf(log: readonly LogLine[], heard: Heard): string | undefined {
  const news = log.filter(
    ({ id, kind, count }) =>
      SPOKEN.has(kind) && (id > heard.id || (id === heard.id && count > heard.count)),
  );
  return news.at(-1)?.text;
}

/** What a change of role is in words; nothing for the first role of a connection's page. */
export function roleWords(before: Model['hello'], now: Model['hello']): string | undefined {
  if (!before || !now || before.role === now.role) return undefined;
  return now.role === 'operator' ? 'You have control.' : 'You are watching.';
}

/** Says the newest of what it is given, at most once a second, and the same text twice as two texts. */
export function createSpeaker(say: (text: string) => void, clock?: Clock): (text: string) => void {
  let last = '';
  const limiter = new Limiter<string>(
    EVERY_MS,
    (text) => {
      // A region is read out when its text changes.
      last = text === last ? `${text}\u00a0` : text;
      say(last);
    },
    clock,
  );
  return (text) => {
    limiter.offer(text);
  };
}
