import { expect, it } from 'vitest';
import { sessionOf, sessionPath } from './session';

it('is named by the address', () => {
  for (const [pathname, session] of [
    ['/', 'main'],
    ['/s/anna', 'anna'],
    ['/s/group-7', 'group-7'],
    ['/s/Anna', 'main'],
    ['/s/anna/more', 'main'],
    [`/s/${'x'.repeat(33)}`, 'main'],
    ['/viewer/', 'main'],
  ] as const) {
    expect(sessionOf({ pathname }), pathname).toBe(session);
  }
});

it('has its resources below its name', () => {
  expect(sessionPath('anna', 'case.json')).toBe('/api/sessions/anna/case.json');
});
