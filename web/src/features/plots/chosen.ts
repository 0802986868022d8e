// Which parts of the figure the lanes show.

import { createMemo, createSignal, type Accessor } from 'solid-js';
import { recall, remember } from '../../ui/storage';
import { isLow } from '../../ui/windowSize';
import { type Part, PARTS } from './parts';

/** From top to bottom. */
const ORDER = ['e', 'a', 'b', 'c', 'd'];
const LANES = 3;
const KEY = 'plots';

/** Letters, the last chosen one at the end: the first ones give way. */
const stored = (recall(KEY) ?? '').split(' ').filter((letter) => ORDER.includes(letter));
const [chosen, setChosen] = createSignal(stored.length > 0 ? stored : ['b', 'a', 'e']);

export const isChosen = (letter: string): boolean => chosen().includes(letter);

export function choosePart(letter: string, isWanted: boolean): void {
  const others = chosen().filter((one) => one !== letter);
  const next = isWanted ? [...others, letter].slice(-LANES) : others;
  setChosen(next);
  remember(KEY, next.join(' '));
}

export const isOnlyOne = (letter: string): boolean => chosen().length === 1 && isChosen(letter);

/** The parts that have room. */
export function createShownParts(): Accessor<readonly Part[]> {
  return createMemo(() => {
    const shown = chosen().slice(isLow() ? 1 - LANES : -LANES);
    return ORDER.filter((letter) => shown.includes(letter)).flatMap((letter) =>
      PARTS.filter((part) => part.letter === letter),
    );
  });
}
