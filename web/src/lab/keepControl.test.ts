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

const SEAT = { seat: 'a1' };
const OPERATOR = { ...SEAT, role: 'operator', operator_present: true } as const;
const WATCHING = { ...SEAT, role: 'viewer', operator_present: true } as const;
const FREE = { ...SEAT, role: 'viewer', operator_present: false } as const;

it('takes control again when the old connection closes last', () => {
  const tab = storage();
  createKeeper('main', tab, vi.fn()).hello(OPERATOR);
  const take = vi.fn();
  const keeper = createKeeper('main', tab, take);
  keeper.opened();
  keeper.hello(WATCHING);
  expect(take).not.toHaveBeenCalled();
  keeper.hello(FREE);
  keeper.hello(FREE);
  expect(take).toHaveBeenCalledOnce();
  keeper.hello(OPERATOR);
  expect(keeper.isReturning()).toBe(true);
  // Released.
  keeper.hello(FREE);
  keeper.hello(FREE);
  expect(keeper.isReturning()).toBe(false);
  expect(take).toHaveBeenCalledOnce();
});

it('does not take control that was released, or of another session', () => {
  const tab = storage();
  const first = createKeeper('main', tab, vi.fn());
  first.hello(OPERATOR);
  const other = vi.fn();
  const keeper = createKeeper('anna', tab, other);
  keeper.opened();
  keeper.hello(FREE);
  expect(other).not.toHaveBeenCalled();
  first.hello(FREE);
  const take = vi.fn();
  const again = createKeeper('main', tab, take);
  again.opened();
  again.hello(FREE);
  expect(take).not.toHaveBeenCalled();
  expect(again.isReturning()).toBe(false);
});

it('takes no control that becomes free later', () => {
  const tab = storage();
  createKeeper('main', tab, vi.fn()).hello(OPERATOR);
  const take = vi.fn();
  vi.useFakeTimers({ now: 0 });
  const keeper = createKeeper('main', tab, take);
  keeper.opened();
  keeper.hello(WATCHING);
  vi.setSystemTime(10_001);
  keeper.hello(FREE);
  expect(take).not.toHaveBeenCalled();
  vi.useRealTimers();
});

it('keeps the key of its seat for the next connection', () => {
  const tab = storage();
  expect(createKeeper('main', tab, vi.fn()).seat()).toBeUndefined();
  createKeeper('main', tab, vi.fn()).hello(WATCHING);
  expect(createKeeper('main', tab, vi.fn()).seat()).toBe('a1');
});
