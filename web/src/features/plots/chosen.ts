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

const shown = (): readonly string[] => chosen().slice(isLow() ? 1 - LANES : -LANES);

export const isShown = (letter: string): boolean => shown().includes(letter);

export const isOnlyOne = (letter: string): boolean => shown().length === 1 && isShown(letter);

export function choosePart(letter: string, isWanted: boolean): void {
  const others = chosen().filter((one) => one !== letter);
  const next = isWanted ? [...others, letter].slice(-LANES) : others;
  setChosen(next);
  remember(KEY, next.join(' '));
}

/** The parts that have room. */
export function createShownParts(): Accessor<readonly Part[]> {
  return createMemo(() =>
    ORDER.filter(isShown).flatMap((letter) => PARTS.filter((part) => part.letter === letter)),
  );
}
