import { expect, it } from 'vitest';
import { isOpen } from './wish';

it.each([
  ['pausing…', 'images', 'learning', true],
  ['pausing…', 'learning', 'paused', false],
  ['pausing…', 'learning', 'examination', false],
  ['resuming…', 'paused', 'paused', true],
  ['resuming…', 'paused', 'waiting', false],
  ['cancelling…', 'learning', 'examination', true],
  ['cancelling…', 'learning', 'cancelled', false],
  // The server was restarted and does not know of it.
  ['cancelling…', 'learning', 'waiting', false],
] as const)('%s: from %s to %s it is open: %s', (words, from, stage, open) => {
  expect(isOpen({ words, from }, stage)).toBe(open);
});
