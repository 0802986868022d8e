import { expect, it } from 'vitest';
import { belowSession } from './copyLink';

const locationOf = (address: string): Pick<Location, 'search' | 'hash'> =>
  new URL(address, 'http://ferry');

it.each([
  ['/copy/#lesson=lift-off', '/learn/lift-off'],
  ['/copy/#challenge=easy-7%20a', '?challenge=easy-7%20a'],
  ['/copy/#lesson=../x', '/learn/..%2Fx'],
  ['/copy/?challenge=easy-x', '?challenge=easy-x'],
  ['/copy/#v=1&map=colon&controller=rl&seed=1', '#v=1&map=colon&controller=rl&seed=1'],
  ['/copy/', ''],
])('%s leads to %s below the session', (link, below) => {
  expect(belowSession(locationOf(link))).toBe(below);
});
