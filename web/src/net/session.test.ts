import { expect, it } from 'vitest';
import { isBoard, sessionOf, sessionPath } from './session';

it('the address names the session', () => {
  for (const [pathname, session] of [
    ['/', 'main'],
    ['/s/anna', 'anna'],
    ['/s/group-7', 'group-7'],
    ['/s/Anna', 'main'],
    ['/s/anna/train', 'anna'],
    [`/s/${'x'.repeat(33)}`, 'main'],
    ['/viewer/', 'main'],
  ] as const) {
    expect(sessionOf({ pathname }), pathname).toBe(session);
  }
});

it('the resources of a session are below its name', () => {
  expect(sessionPath('anna', 'case.json')).toBe('/api/sessions/anna/case.json');
});

it('a board has an address of its own', () => {
  const paths = ['/board', '/', '/s/board', '/board/x'];
  expect(paths.filter((pathname) => isBoard({ pathname }))).toEqual(['/board']);
});
