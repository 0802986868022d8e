import { describe, expect, it } from 'vitest';
import type { BoardEntry, ChallengeSummary } from '../../net/protocol.gen';
import {
  added,
  boardAddress,
  chosenIn,
  classesOf,
  easyOfToday,
  longTitle,
  newWords,
  pageTitle,
  rowsOf,
  shortTitle,
  when,
} from './entries';

const entry = (player: string, total_s: number, ofClass: string | null = null): BoardEntry => ({
  player,
  class: ofClass,
  at: '2026-11-26T09:30:00Z',
  score: { tick: 1000, walls: 2, lost_beads: 1 },
  total_s,
});
const rules = (...board: BoardEntry[]) => ({ board, wall_s: 1, lost_bead_s: 5 });
const summary = (name: string, period: 'day' | 'week' | null): ChallengeSummary => ({
  name,
  difficulty: name.startsWith('easy') ? 'easy' : 'hard',
  period,
  entries: 0,
  best: null,
});

describe('the address', () => {
  it.each([
    ['', undefined, undefined],
    ['?challenge=easy-2026-11-26', 'easy-2026-11-26', undefined],
    ['?challenge=hard-x&class=7+a', 'hard-x', '7 a'],
    ['?class=%C3%A4%26b', undefined, 'ä&b'],
  ])('“%s” is read and written', (search, challenge, ofClass) => {
    const chosen = chosenIn(search);
    expect(chosen).toEqual({ challenge, ofClass });
    expect(boardAddress(chosen)).toBe(`/board${search}`);
  });

  it('without a value chooses nothing', () => {
    expect(chosenIn('?challenge=&class=%20')).toEqual({});
  });
});

describe('names', () => {
  const [week, day] = [summary('easy-2026-w48', 'week'), summary('easy-2026-11-26', 'day')];
  const earlier = summary('hard-2026-w40', null);

  it('the easy one of today is found by its period', () => {
    expect(easyOfToday([week, day, earlier])).toBe('easy-2026-11-26');
    expect(easyOfToday([])).toBeUndefined();
  });

  it('say what is offered, and name what is not', () => {
    expect([week, day, earlier].map(shortTitle)).toEqual([
      'Easy this week',
      'Easy today',
      'hard-2026-w40',
    ]);
    expect(longTitle(day.name, day)).toBe('Easy challenge of today');
    expect(longTitle(earlier.name, earlier)).toBe('Challenge hard-2026-w40');
    expect(longTitle('easy-x', undefined)).toBe('Challenge easy-x');
    expect(pageTitle('easy-x', undefined)).toBe('Board · easy-x – Ferry');
    expect(pageTitle('easy-x', '7a')).toBe('Board · easy-x · class 7a – Ferry');
    expect(pageTitle(undefined, undefined)).toBe('Board – Ferry');
  });
});

describe('a board', () => {
  const board = [
    entry('Ada', 15, '10b'),
    entry('Bob', 16),
    entry('Cy', 17, '9a'),
    entry('Di', 18, '10b'),
  ];

  it('has its classes in order, with the chosen one', () => {
    expect(classesOf(board, undefined)).toEqual(['9a', '10b']);
    expect(classesOf(board, '9c')).toEqual(['9a', '9c', '10b']);
  });

  it('counts places within the class', () => {
    const rows = rowsOf(rules(...board), '10b');
    expect(rows.map(({ place, entry: { player } }) => [place, player])).toEqual([
      [1, 'Ada'],
      [2, 'Di'],
    ]);
    expect(rows[0]?.time_s).toBe(8);
  });

  it('keeps rows that did not change', () => {
    const before = rowsOf(rules(...board), undefined);
    const better = [...board.slice(0, 1), entry('Zoe', 15.5), ...board.slice(1)];
    const after = rowsOf(rules(...better.map((one) => ({ ...one }))), undefined, before);
    expect(after[0]).toBe(before[0]);
    expect(after[2]).toMatchObject({ place: 3, entry: { player: 'Bob' } });
  });

  it('names the new entries, also a better attempt of the same player', () => {
    const again = { ...entry('Bob', 14), at: '2026-11-26T10:00:00Z' };
    const after = [again, ...board.filter(({ player }) => player !== 'Bob')];
    expect(added(after, board)).toEqual([again]);
    expect(added(board, board)).toEqual([]);
    const [first] = rowsOf(rules(...after), undefined);
    expect(first && newWords(first)).toBe('New: Bob, place 1, 14.0 s');
  });
});

describe('the time of an attempt', () => {
  const at = '2026-11-26T09:30:00Z';

  it('is a clock time today and a date before', () => {
    expect(when(at, new Date('2026-11-26T22:00:00Z'), 'en', 'Europe/Berlin')).toBe('10:30');
    expect(when(at, new Date('2026-11-27T00:00:00Z'), 'en', 'Europe/Berlin')).toBe('Nov 26');
  });

  it('has the hour 00 after midnight', () => {
    const midnight = '2026-11-26T00:05:00Z';
    expect(when(midnight, new Date(midnight), 'en-US', 'UTC')).toBe('00:05');
  });
});
