import { expect, it } from 'vitest';
import { eventAt } from '../../lab/testingFacts';
import type { CaseSummary, EventMessage } from '../../net/protocol.gen';
import { caseWords, fits } from './cases';

const CASE: CaseSummary = {
  about: 'rl colon pushed back',
  inputs: 3,
  last_tick: 700,
  deliveries: 1,
  by_tick: 8202,
};

const deliveredAt = (tick: number): EventMessage => eventAt(tick, 'delivered');

const lastOf = (events: EventMessage[], tick: number) =>
  caseWords(CASE, events, { tick }, 0.008).at(-1);

it('says what a test case contains', () => {
  expect(caseWords(CASE, [], { tick: 0 }, 0.008)).toEqual([
    'Test case: rl colon pushed back',
    '3 inputs, the last one at 5.6 s.',
    'Expected: 1 delivered by 1:05.6 (open).',
  ]);
  const bare = { about: 'a', inputs: 0, last_tick: 0 };
  expect(caseWords(bare, [], { tick: 9 }, 0.008)).toEqual(['Test case: a']);
});

it.each([
  ['in time', [deliveredAt(4000)], 9000, 'met'],
  ['in time, seen from an earlier moment', [deliveredAt(4000)], 3999, 'open'],
  ['too late', [deliveredAt(8203)], 9000, 'not met'],
  ['never', [], 8202, 'not met'],
] as const)('judges a delivery %s', (_, events, tick, verdict) => {
  expect(lastOf([...events], tick)).toBe(`Expected: 1 delivered by 1:05.6 (${verdict}).`);
});

it('knows whether a file fits into a message', () => {
  expect(fits('x'.repeat(7000), 9000)).toBe(true);
  // Each of these takes two bytes more in a message.
  expect(fits('"'.repeat(7000), 9000)).toBe(false);
});
