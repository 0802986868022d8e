import { expect, test } from 'vitest';
import type { RecordingContent, RecordingFile } from '../../net/protocol.gen';
import { joined, nameOf, shown } from './names';

const CONTENT: RecordingContent = {
  maps: ['colon'],
  controllers: ['rl'],
  delivered: 0,
  not_delivered: 0,
  duration_s: 61,
};
const FILE: RecordingFile = {
  id: '20260301-210409-045-anna',
  session: 'anna',
  started: '2026-03-01T21:04:09.045Z',
  bytes: 1,
  log_bytes: null,
  live: false,
  title: null,
  content: CONTENT,
};

test.each<[Partial<RecordingContent>, string]>([
  [{ delivered: 2, not_delivered: 1 }, 'Colon, RL: 2 delivered, 1 not delivered'],
  [{ delivered: 1 }, 'Colon, RL: 1 delivered'],
  [{ not_delivered: 3 }, 'Colon, RL: 3 not delivered'],
  [{}, 'Colon, RL: nothing delivered'],
  [{ controllers: [] }, 'Colon, no goal'],
  [{ maps: [], controllers: [] }, 'Not run'],
  [
    { maps: ['colon', 'posts'], controllers: ['rl', 'errt', 'attractor'], delivered: 4 },
    'Colon and posts, RL, ERRT and Attractor: 4 delivered',
  ],
  [{ maps: ['a', 'b', 'c', 'd'] }, 'A, b and 2 more, RL: nothing delivered'],
])('a recording with %o is named “%s”', (content, name) => {
  expect(shown({ ...CONTENT, ...content }, false)).toBe(name);
});

test('a session that has not run yet says so', () => {
  expect(shown({ ...CONTENT, maps: [] }, true)).toBe('Not run yet');
});

test('a title comes first; without content the name is the session or the file', () => {
  expect(nameOf({ ...FILE, title: 'Second try' })).toBe('Second try');
  expect(nameOf(FILE)).toBe('Colon, RL: nothing delivered');
  expect(nameOf({ ...FILE, content: null })).toBe('anna');
  expect(nameOf({ ...FILE, content: null, session: null, started: null, id: 'a b' })).toBe('a b');
});

test.each([
  [[], ''],
  [['a'], 'a'],
  [['a', 'b'], 'a and b'],
  [['a', 'b', 'c'], 'a, b and c'],
  [['a', 'b', 'c', 'd', 'e'], 'a, b and 3 more'],
])('%j are joined as “%s”', (names, text) => {
  expect(joined(names)).toBe(text);
});
