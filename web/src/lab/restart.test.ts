import { expect, it } from 'vitest';
import { restartText } from './restart';

const GOES_ON = 'This session was interrupted. It goes on at 12.3 s, paused.';

it('says what became of the session after an interruption', () => {
  const resumed = { opened: 'noon', resumed_s: 12.304 };
  expect(restartText(resumed, 'morning', 12.304)).toBe(GOES_ON);
  expect(restartText(resumed, 'morning', 12.4)).toBe(GOES_ON);
  expect(restartText(resumed, 'noon', 12.304)).toBeUndefined();
  const fresh = { opened: 'noon', resumed_s: null };
  expect(restartText(fresh, 'morning', 0)).toBe('This session was interrupted. It started over.');
  expect(restartText(fresh, 'noon', 0)).toBeUndefined();
});

it('tells a page that has just come only while nothing has happened since', () => {
  const resumed = { opened: 'noon', resumed_s: 12.304 };
  expect(restartText(resumed, undefined, 12.304)).toBe(GOES_ON);
  expect(restartText(resumed, undefined, 20)).toBeUndefined();
  expect(restartText({ opened: 'noon', resumed_s: null }, undefined, 0)).toBeUndefined();
});
