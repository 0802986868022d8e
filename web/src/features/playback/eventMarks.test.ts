import { expect, test } from 'vitest';
import { eventAt } from '../../lab/testingFacts';
import { clusters, markTitle } from './eventMarks';
import type { EventKind, EventMessage } from '../../net/protocol.gen';

const at = (tick: number, kind: EventKind): EventMessage =>
  eventAt(tick, kind, { code: 'took_up', about: kind });

test('events that would overlap share a button with the name of the most important one', () => {
  const events = [at(0, 'goal'), at(10, 'disturbance'), at(12, 'switch'), at(200, 'delivered')];
  const found = clusters(events, (tick) => tick, 24);
  expect(found.map(({ px, symbol, events }) => [px, symbol, events.length])).toEqual([
    [0, '⇄', 3],
    [200, '✓', 1],
  ]);
  expect(found[0]?.name).toBe('Switch at 0.1 s: set up: switch, and 2 more');
  expect(found[1]?.name).toBe('Delivered at 1.6 s: set up: delivered');
});

test('a title names the events of a mark, but not hundreds of them', () => {
  expect(markTitle([at(0, 'goal'), at(200, 'delivered')])).toBe(
    'Goal at 0.0 s\nDelivered at 1.6 s\nClick: why',
  );
  const many = markTitle(Array.from({ length: 500 }, (_, tick) => at(tick, 'switch')));
  expect(many.split('\n').slice(-2)).toEqual(['and 494 more', 'Click: why']);
});

test('buttons keep their distance with any number of events', () => {
  const events = Array.from({ length: 500 }, (_, tick) => at(tick, 'disturbance'));
  const found = clusters(events, (tick) => tick / 2, 24);
  for (const [index, { px }] of found.entries()) {
    expect(px - (found[index - 1]?.px ?? -24)).toBeGreaterThanOrEqual(24);
  }
  expect(found.flatMap(({ events }) => events)).toEqual(events);
});

test('events of the session itself have no mark', () => {
  expect(clusters([at(0, 'session')], (tick) => tick, 24)).toEqual([]);
});
