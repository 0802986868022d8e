import { describe, expect, it, vi } from 'vitest';
import { createAnnouncer, lastLine, newsOf, roleWords } from './announce';
import type { LogLine } from '../lab/model';
import type { Hello } from '../net/protocol.gen';

const line = (id: number, kind: LogLine['kind'], text: string = kind, count = 1): LogLine => ({
  id,
  kind,
  text,
  count,
  sim_time_s: 0,
  event: undefined,
});

describe('announcements', () => {
  it('contain the newest important line, each line once', () => {
    const log = [line(1, 'session'), line(2, 'switch'), line(3, 'delivered'), line(4, 'refused')];
    const announced = lastLine([]);
    expect(newsOf(log, announced)).toBe('delivered');
    expect(newsOf(log, lastLine(log))).toBeUndefined();
  });

  it('repeat a line when it happens again', () => {
    const before = [line(1, 'disturbance', 'a kick')];
    expect(newsOf([line(1, 'disturbance', 'a kick', 2)], lastLine(before))).toBe('a kick');
  });

  it('report a change of role, but not the first role', () => {
    const as = (role: Hello['role']): Hello => ({
      protocol: 1,
      message_bytes: 65536,
      session: 'main',
      seat: 'a1',
      version: '',
      role,
      epoch: 1,
      operator_present: true,
      asked: false,
      asks: false,
      ahead: 0,
      answer_within_s: null,
      adapter: '',
      opened: 'noon',
      resumed_s: null,
    });
    expect(roleWords(undefined, as('operator'))).toBeUndefined();
    expect(roleWords(as('operator'), as('operator'))).toBeUndefined();
    expect(roleWords(as('operator'), as('viewer'))).toBe('You are watching.');
    expect(roleWords(as('viewer'), as('operator'))).toBe('You have control.');
  });
});

describe('the announcer', () => {
  it('announces the newest text once per second, and a repeated text again', () => {
    vi.useFakeTimers();
    const said: string[] = [];
    const say = createAnnouncer((text) => said.push(text));
    say('a');
    say('b');
    say('c');
    expect(said).toEqual(['a']);
    vi.advanceTimersByTime(1000);
    expect(said).toEqual(['a', 'c']);
    vi.advanceTimersByTime(1000);
    say('c');
    expect(said[2]).not.toBe('c');
    expect(said[2]?.trim()).toBe('c');
    vi.useRealTimers();
  });
});
