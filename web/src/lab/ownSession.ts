// The address of a new session, with a name that can be read aloud.

import { addressOf } from '../net/base';

const HOW = ['amber', 'brave', 'calm', 'clear', 'keen', 'mild', 'neat', 'quick', 'quiet', 'warm'];
const WHO = ['crane', 'finch', 'heron', 'lark', 'otter', 'plaice', 'robin', 'seal', 'tern', 'wren'];
/** Long enough that two pages do not choose the same name. */
const LETTERS = 5;

const letter = (number: number): string => (number % 36).toString(36);

/** Such as `calm-otter-7k2dq`. */
export function newName(): string {
  const [how = 0, who = 0, ...rest] = crypto.getRandomValues(new Uint8Array(2 + LETTERS));
  return [HOW[how % HOW.length], WHO[who % WHO.length], rest.map(letter).join('')].join('-');
}

/** The server opens the session when a page of its own site goes there. */
export const ownAddress = (rest = ''): string => addressOf(`/s/${newName()}${rest}`);
