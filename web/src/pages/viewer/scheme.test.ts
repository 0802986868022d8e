import { expect, test } from 'vitest';
import { Scheme } from './scheme';

class List extends EventTarget {
  readonly matches = true;
}

test('answers media queries by the theme, and reports a change of it', () => {
  const scheme = new Scheme('dark');
  const matchMedia = scheme.answering(() => new List() as unknown as MediaQueryList);
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const light = matchMedia('(prefers-color-scheme: light)');
  expect([dark.matches, light.matches]).toEqual([true, false]);
  const results: boolean[] = [];
  dark.addEventListener('change', () => results.push(dark.matches));
  scheme.set('light');
  expect([dark.matches, light.matches]).toEqual([false, true]);
  expect(results).toEqual([false]);
});

test('leaves other media queries to the browser', () => {
  const other = new Scheme('light').answering(() => new List() as unknown as MediaQueryList);
  expect(other('(min-width: 100px)').matches).toBe(true);
});
