import { afterEach, expect, it, vi } from 'vitest';
import { createChoice, recall, remember } from './storage';

afterEach(() => {
  vi.unstubAllGlobals();
});

function allowStorage(stored = new Map<string, string>()): Map<string, string> {
  vi.stubGlobal('localStorage', {
    getItem: (key: string) => stored.get(key) ?? null,
    setItem: (key: string, value: string) => stored.set(key, value),
  });
  return stored;
}

const forbidden = (): never => {
  throw new Error('forbidden');
};

it('stores choices', () => {
  const stored = allowStorage();
  remember('panel', 'open');
  expect([...stored]).toEqual([['ferry.panel', 'open']]);
  expect(recall('panel')).toBe('open');
  expect(recall('other')).toBeNull();
});

it('keeps choices within the page if storage is forbidden', () => {
  vi.stubGlobal('localStorage', { getItem: forbidden, setItem: forbidden });
  expect(recall('tips')).toBeNull();
  remember('tips', 'run');
  expect(recall('tips')).toBe('run');
  remember('tips', 'run,drag');
  expect(recall('tips')).toBe('run,drag');
});

it('prefers a choice that could not be stored to the stored one, until one can be stored again', () => {
  const stored = allowStorage();
  remember('theme', 'dark');
  vi.stubGlobal('localStorage', { getItem: () => 'dark', setItem: forbidden });
  remember('theme', 'light');
  expect(recall('theme')).toBe('light');
  allowStorage(stored);
  remember('theme', 'dark');
  stored.set('ferry.theme', 'high');
  expect(recall('theme')).toBe('high');
});

it('keeps a choice, and none that no longer exists', () => {
  const stored = allowStorage();
  const [view, choose] = createChoice('view', ['plan', 'scene']);
  expect(view()).toBe('plan');
  choose('scene');
  expect(view()).toBe('scene');
  expect(createChoice('view', ['plan', 'scene'])[0]()).toBe('scene');
  stored.set('ferry.view', 'toString');
  expect(createChoice('view', ['plan', 'scene'])[0]()).toBe('plan');
});
