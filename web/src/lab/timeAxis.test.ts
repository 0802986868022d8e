import { expect, it } from 'vitest';
import { shownSpan } from './timeAxis';

it('grows in steps and covers at least ten seconds', () => {
  expect(shownSpan('all', 0, 3, 3)).toEqual({ from_s: 0, to_s: 10 });
  expect(shownSpan('all', 0, 41, 20)).toEqual({ from_s: 0, to_s: 50 });
  expect(shownSpan('all', 0, 901, 20)).toEqual({ from_s: 0, to_s: 1000 });
  expect(shownSpan('all', 3600, 3612, 3612)).toEqual({ from_s: 3600, to_s: 3615 });
});

it('goes with the time in steps of a quarter of its width', () => {
  expect(shownSpan('60', 0, 3, 3)).toEqual({ from_s: 0, to_s: 60 });
  expect(shownSpan('60', 0, 100, 100)).toEqual({ from_s: 45, to_s: 105 });
});

it('stays when the rewound time is inside it, and follows the time otherwise', () => {
  expect(shownSpan('60', 0, 100, 56)).toEqual({ from_s: 45, to_s: 105 });
  expect(shownSpan('10', 0, 100, 50)).toEqual({ from_s: 45, to_s: 55 });
  expect(shownSpan('10', 0, 100, 2)).toEqual({ from_s: 0, to_s: 10 });
});
