import { expect, test } from 'vitest';
import { eventAt } from '../../lab/testingFacts';
import { clusters, markTitle } from './eventMarks';
import { stretches } from './stretches';
import type { ControllerName, EventKind, EventMessage } from '../../net/protocol.gen';

const at = (tick: number, kind: EventKind): EventMessage =>
  eventAt(tick, kind, { code: 'took_up', about: kind });
/** One pixel for each tick. */
const px = (time_s: number): number => Math.round(time_s / 0.008);

test('events that would overlap share a button with the name of the most important one', () => {
  const events = [at(0, 'goal'), at(10, 'disturbance'), at(12, 'switch'), at(200, 'delivered')];
  const found = clusters(events, px, 24);
  expect(found.map(({ px, look, events }) => [px, look.colour, events.length])).toEqual([
    [0, 'ink-2', 3],
    [200, 'goal', 1],
  ]);
  expect(found[0]?.name).toBe('Switch at 0.1 s: set up: switch, one of 3 events');
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
  const found = clusters(events, (time_s) => px(time_s) / 2, 24);
  for (const [index, { px }] of found.entries()) {
    expect(px - (found[index - 1]?.px ?? -24)).toBeGreaterThanOrEqual(24);
  }
  expect(found.flatMap(({ events }) => events)).toEqual(events);
});

test('events of the session itself have no mark', () => {
  expect(clusters([at(0, 'session')], px, 24)).toEqual([]);
});

const chooses = (tick: number, controller: ControllerName): EventMessage =>
  eventAt(tick, 'session', { code: 'controller_selected', controller });
const takesOver = (tick: number, sub_controller: number): EventMessage =>
  eventAt(tick, 'switch', {
    code: 'took_over',
    sub_controller,
    reason: { code: 'held', error_m: 0, threshold_m: 0.1, text: '' },
  });

test('the band has a stretch for each controller, and for each fetch', () => {
  const events = [takesOver(50, 1), takesOver(80, 2), chooses(80, 'errt'), at(90, 'goal')];
  expect(stretches(events, 'rl', { mode: 2, controller: 'errt' })).toEqual([
    { from_tick: 0, controller: 'rl', isFetching: false },
    { from_tick: 50, controller: 'rl', isFetching: true },
    { from_tick: 80, controller: 'errt', isFetching: false },
  ]);
});

test('the band begins with the fetch that the first takeover ends', () => {
  expect(stretches([], 'rl', { mode: 1, controller: 'rl' })).toEqual([
    { from_tick: 0, controller: 'rl', isFetching: true },
  ]);
  const [start] = stretches([takesOver(50, 2)], 'rl', { mode: 2, controller: 'rl' });
  expect(start).toEqual({ from_tick: 0, controller: 'rl', isFetching: true });
});

test('the band has no controller where events are missing, and the one that steers now', () => {
  const many = Array.from({ length: 500 }, (_, tick) => at(tick, 'goal'));
  const found = stretches([...many, chooses(600, 'errt')], 'rl', { mode: 2, controller: 'robot' });
  expect(found.map(({ controller }) => controller)).toEqual([undefined, 'robot']);
});
