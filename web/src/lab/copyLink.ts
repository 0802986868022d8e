// Links to the page `/copy/`, which opens what they name in a session of the reader's own.

import { addressOf } from '../net/base';
import { playQuery } from './challenges';

const copyAddress = (kind: string, name: string): string =>
  window.location.origin + addressOf(`/copy/#${kind}=${encodeURIComponent(name)}`);

/** A lesson, for each of a class. */
export const lessonCopy = (lesson: string): string => copyAddress('lesson', lesson);

/** A challenge, for each player. */
export const challengeCopy = (challenge: string): string => copyAddress('challenge', challenge);

/** What follows `/s/NAME` in the address that such a link leads to. An experiment stays as it is. */
export function belowSession({ search, hash }: Pick<Location, 'search' | 'hash'>): string {
  const named = new URLSearchParams(hash.slice(1));
  const [lesson, challenge] = [named.get('lesson'), named.get('challenge')];
  if (lesson !== null) return `/learn/${encodeURIComponent(lesson)}`;
  if (challenge !== null) return playQuery(challenge);
  return search + hash;
}
