import { describe, expect, it } from 'vitest';
import type { Place } from './places';
import { EMPTY, type Input, LOG_LINES, type Model, type ModelMessage, reduce } from './model';
import { type EventMessage, PROTOCOL_VERSION } from '../net/protocol.gen';
import { comparisonOf, sceneOf, stateAt } from './testing';
import { eventAt } from './testingFacts';

const message = (one: ModelMessage): Input => ({ type: 'message', message: one });
const scene = (map = 'posts', trial = 0): Input =>
  message({ type: 'scene', ...sceneOf(map, trial) });
const state = (tick: number): Input => message({ type: 'state', ...stateAt(tick) });
const event = (tick: number, kind: EventMessage['kind'] = 'switch'): Input =>
  message({ type: 'event', ...eventAt(tick, kind) });
/** An event of the past of the run, to which the session has returned. */
const again = (tick: number): Input => message({ type: 'event', ...eventAt(tick), again: true });
const play = (...inputs: Input[]): Model => inputs.reduce(reduce, EMPTY);

describe('messages', () => {
  it('keep the newest scene and state', () => {
    const model = play(scene(), state(1), state(2));
    expect(model.scene?.map).toBe('posts');
    expect(model.state?.tick).toBe(2);
  });

  it('of another protocol stop the page', () => {
    const hello = {
      protocol: 99,
      message_bytes: 65536,
      session: 'main',
      seat: 'a1',
      version: '9',
      role: 'operator',
      epoch: 1,
      operator_present: true,
      asked: false,
      asks: false,
      ahead: 0,
      answer_within_s: null,
      adapter: '',
      opened: 'noon',
      resumed_s: null,
    } as const;
    expect(play(message({ type: 'hello', ...hello })).connection.kind).toBe('outdated');
    expect(
      play(message({ type: 'hello', ...hello, protocol: PROTOCOL_VERSION })).connection.kind,
    ).toBe('connecting');
  });
});

describe('the timeline', () => {
  it('drops only marks after the tick of a rewind', () => {
    const model = play(state(100), event(40), event(90), event(100), state(50));
    expect(model.marks.map(({ tick }) => tick)).toEqual([40]);
    expect(model.log).toHaveLength(3);
  });

  it('keeps a mark that arrives before its state', () => {
    expect(play(state(99), event(100), state(100)).marks).toHaveLength(1);
  });

  it('is cleared by a new trial', () => {
    expect(play(event(0, 'goal'), event(0, 'session')).marks.map(({ kind }) => kind)).toEqual([
      'session',
    ]);
    expect(play(event(5, 'goal'), event(9, 'session')).marks).toHaveLength(2);
  });

  it('is empty in another trial, but not in the same one', () => {
    expect(play(scene(), event(5), scene()).marks).toHaveLength(1);
    expect(play(scene(), event(5), scene('posts', 1)).marks).toHaveLength(0);
  });
});

describe('events that are sent again', () => {
  it('are on the timeline as the objects of their log lines, and are not logged again', () => {
    const model = play(scene(), event(5), event(9), scene('posts', 1), again(5), again(9));
    expect(model.log).toHaveLength(2);
    expect(model.marks).toHaveLength(2);
    model.marks.forEach((mark, index) => expect(mark).toBe(model.log[index]?.event));
  });

  it('are on the timeline without a log line, too', () => {
    const model = play(again(5));
    expect(model.marks.map(({ tick }) => tick)).toEqual([5]);
    expect(model.log).toEqual([]);
  });

  it('have the newest of equal log lines', () => {
    const model = play(event(5), event(9), event(5), scene(), scene('posts', 1), again(5));
    expect(model.marks[0]).toBe(model.log[2]?.event);
  });

  it('are on the timeline once', () => {
    expect(play(event(5), again(5), again(5)).marks).toHaveLength(1);
    const live = play(again(5), event(5), event(5));
    expect(live.marks).toHaveLength(1);
    expect(live.log.map(({ count }) => count)).toEqual([2]);
    // Another kind is another event.
    expect(play(event(5), event(5, 'goal')).marks).toHaveLength(2);
  });
});

describe('a comparison', () => {
  const link = (connection: Model['connection']): Input => ({
    type: 'connection',
    connection,
  });
  it('from before a lost connection is sent again or dropped', () => {
    const before = play(
      link({ kind: 'live' }),
      scene(),
      message({ type: 'comparison', ...comparisonOf(0, []) }),
    );
    expect(before.comparison).toBeDefined();
    const lost = reduce(before, link({ kind: 'lost', attempt: 1 }));
    expect(lost.comparison).toBeDefined();
    expect(reduce(lost, link({ kind: 'live' })).comparison).toBeUndefined();
  });
});

describe('the log', () => {
  it('counts repeated lines', () => {
    const refusal = message({ type: 'error', code: 'in_wall', values: {}, message: 'In a wall.' });
    const { log } = play(refusal, refusal, refusal);
    expect(log.map(({ text, count }) => [text, count])).toEqual([
      [expect.stringContaining('is in a wall'), 3],
    ]);
  });

  it('is limited and gives each line a unique id', () => {
    const model = play(...Array.from({ length: LOG_LINES + 50 }, (_, tick) => event(tick)));
    expect(model.log).toHaveLength(LOG_LINES);
    expect(new Set(model.log.map(({ id }) => id)).size).toBe(LOG_LINES);
    expect(model.log.at(-1)?.text).toBe(`set up: at ${LOG_LINES + 49}`);
  });

  it('reports once that the connection was lost, and once that it is back', () => {
    const link = (connection: Model['connection']): Input => ({
      type: 'connection',
      connection,
    });
    const model = play(
      link({ kind: 'live' }),
      link({ kind: 'lost', attempt: 1 }),
      link({ kind: 'lost', attempt: 2 }),
      link({ kind: 'live' }),
    );
    expect(model.log.map(({ kind }) => kind)).toEqual(['connection', 'connection']);
  });
});

describe('a refusal', () => {
  const refused = (place: Place): Input => ({
    type: 'answer',
    place,
    answer: { type: 'refused', id: 1, code: 'in_wall', values: {}, detail: 'In a wall.' },
  });
  const sent = (place: Place): Input => ({ type: 'sent', place });

  it('because of a silent hand is counted, and appears in the workspace', () => {
    const silent = message({ type: 'error', code: 'hand_silent', values: {}, message: '' });
    const model = play(silent);
    expect(model.silences).toBe(1);
    expect(model.notices.workspace?.text).toContain('released the bead');
  });

  it('disappears with the next attempt or when dismissed, but a newer one stays', () => {
    const model = play(sent('workspace'), refused('workspace'));
    const id = model.notices.workspace?.id ?? 0;
    expect(model.notices.workspace?.text).toContain('is in a wall');
    expect(reduce(model, sent('workspace')).notices).toEqual({});
    expect(reduce(model, sent('playback')).notices.workspace).toBeDefined();
    expect(reduce(model, { type: 'dismiss', place: 'workspace', id }).notices).toEqual({});
    expect(reduce(model, { type: 'dismiss', place: 'workspace', id: id - 1 })).toBe(model);
  });
});
