import { afterEach, expect, it } from 'vitest';
import { createRoot } from 'solid-js';
import { createAddress, leaveAddress } from './address';

/** The parts of a window that an address needs, with a history that a test walks. */
function browserAt(path: string) {
  const entries = [new URL(path, 'http://ferry')];
  let at = 0;
  const target = new EventTarget();
  const page = {
    location: {
      get href() {
        return entries[at]?.href;
      },
      get pathname() {
        return entries[at]?.pathname;
      },
    },
    history: {
      state: null,
      pushState: (_: unknown, __: string, to: string) => {
        entries.splice(at + 1, Infinity, new URL(to, 'http://ferry'));
        at += 1;
      },
      replaceState: (_: unknown, __: string, to: URL) => {
        entries[at] = to;
      },
    },
    addEventListener: target.addEventListener.bind(target),
    removeEventListener: target.removeEventListener.bind(target),
  } as unknown as Window;
  const walk = (by: number): void => {
    at += by;
    target.dispatchEvent(new Event('popstate'));
  };
  return { page, walk, path: () => page.location.pathname };
}

const ends: (() => void)[] = [];
afterEach(() => {
  for (const end of ends.splice(0)) end();
});
function openedAt(path: string) {
  const browser = browserAt(path);
  const address = createRoot((end) => {
    ends.push(end);
    return createAddress(browser.page);
  });
  return { ...browser, address, place: () => [address.view(), address.lesson()] };
}

it('reads the view and the lesson', () => {
  for (const [path, ...place] of [
    ['/', 'laboratory', undefined],
    ['/demo', 'laboratory', undefined],
    ['/s/anna', 'laboratory', undefined],
    ['/s/anna/train', 'train', undefined],
    ['/s/anna/learn/lift-off', 'laboratory', 'lift-off'],
    ['/s/anna/toString', 'laboratory', undefined],
  ] as const) {
    expect(openedAt(path).place(), path).toEqual(place);
  }
});

it('writes what it shows, and follows Back and Forward', () => {
  const { address, path, place, walk } = openedAt('/');
  address.show('laboratory');
  expect(path(), 'nothing has changed').toBe('/');
  address.show('draw');
  expect(path()).toBe('/s/main/draw');
  address.show('laboratory');
  address.learn('magnet');
  expect(path()).toBe('/s/main/learn/magnet');
  address.show('train');
  expect(path()).toBe('/s/main/train');
  expect(address.of('laboratory'), 'the lesson stays open').toBe('/s/main/learn/magnet');
  walk(-1);
  expect(place()).toEqual(['laboratory', 'magnet']);
  walk(-1);
  expect(place()).toEqual(['laboratory', undefined]);
  walk(-1);
  expect(place()).toEqual(['draw', undefined]);
  walk(2);
  expect(place()).toEqual(['laboratory', 'magnet']);
  address.learn(undefined);
  expect(path()).toBe('/s/main');
});

it('takes a part out of the address, without a new entry', () => {
  const { page } = browserAt('/s/anna/draw?challenge=far#map=colon');
  leaveAddress(page, 'hash');
  expect(page.location.href).toBe('http://ferry/s/anna/draw?challenge=far');
  leaveAddress(page, 'search');
  expect(page.location.href).toBe('http://ferry/s/anna/draw');
});
