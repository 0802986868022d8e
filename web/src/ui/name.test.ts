import { expect, it } from 'vitest';
import { shownName } from './name';

const inside = (name: string): string => shownName(name).replace(/^\u2068(.*)\u2069$/u, '$1');

it.each(['Ada', 'Zoë', 'أحمد', 'می‌خواهم', '👩‍🚀', '❤️', '🇩🇪', '田中'])('keeps “%s”', (name) => {
  expect(inside(name)).toBe(name);
});

it.each([
  ['Ada\u202e3 ecalp', 'Ada\ufffd3 ecalp'],
  ['\u2069\u202eAda', '\ufffd\ufffdAda'],
  ['Ada\u200b', 'Ada\ufffd'],
  ['Ada\u200d', 'Ada\ufffd'],
  ['A\u00adda', 'A\ufffdda'],
  ['\u3164', '\ufffd'],
  ['\u{e0041}', '\ufffd'],
  ['Ada\n', 'Ada\ufffd'],
])('shows what “%s” hides, and isolates it', (name, shown) => {
  expect(shownName(name)).toBe(`\u2068${shown}\u2069`);
});
