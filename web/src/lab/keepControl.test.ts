import { expect, it, vi } from 'vitest';
import { createKeeper } from './keepControl';

function storage() {
  const items = new Map<string, string>();
  return {
    getItem: (key: string) => items.get(key) ?? null,
    setItem: (key: string, value: string) => void items.set(key, value),
    removeItem: (key: string) => void items.delete(key),
  };
}

const OPERATOR = { seat: 'a1', role: 'operator' } as const;
const WATCHING = { seat: 'a1', role: 'viewer' } as const;

/** Another load of the page. */
function again(session: string, tab = storage()) {
  const keeper = createKeeper(session, tab);
  keeper.opened();
  return keeper;
}

it('may return for ten seconds after its page was loaded again', () => {
  vi.useFakeTimers({ now: 0 });
  const tab = storage();
  createKeeper('main', tab).hello(OPERATOR);
  expect(again('anna', tab).isReturning()).toBe(false);
  const keeper = again('main', tab);
  keeper.hello(WATCHING);
  expect(keeper.isReturning()).toBe(true);
  vi.setSystemTime(10_001);
  expect(keeper.isReturning()).toBe(false);
  vi.useRealTimers();
});

it('does not return after it has released control', () => {
  const tab = storage();
  const keeper = again('main', tab);
  keeper.hello(OPERATOR);
  keeper.hello(WATCHING);
  expect([keeper.isReturning(), again('main', tab).isReturning()]).toEqual([false, false]);
});

it('keeps the key of its seat for the next connection', () => {
  const tab = storage();
  expect(again('main', tab).seat()).toBeUndefined();
  createKeeper('main', tab).hello(WATCHING);
  expect(again('main', tab).seat()).toBe('a1');
});
