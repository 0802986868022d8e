import { createRoot, createSignal } from 'solid-js';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createAnswerFrom } from './requests';
import { problemOf } from './problem';

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

const INTERVAL_MS = 1000;

/** A server that answers when the test decides. */
function bench() {
  const pending = new Map<string, { yes: (data: number) => void; no: (reason: Error) => void }>();
  const [question, ask] = createSignal<string>();
  const [key, setKey] = createSignal('colon');
  const [answer, close] = createRoot((dispose) => [
    createAnswerFrom<number>(
      (asked) => new Promise((yes, no) => pending.set(asked, { yes, no })),
      question,
      { key, perS: 1000 / INTERVAL_MS },
    ),
    dispose,
  ]);
  const next = (): void => {
    vi.advanceTimersByTime(INTERVAL_MS);
  };
  const settle = (): Promise<unknown> => vi.advanceTimersByTimeAsync(0);
  return { pending, answer, ask, setKey, next, settle, close };
}

describe('an answer', () => {
  it('is asked for with the newest query of an interval', () => {
    const { ask, pending, next } = bench();
    for (const question of ['1', '2', '3']) ask(question);
    next();
    expect([...pending.keys()]).toEqual(['1', '3']);
  });

  it('is dropped if it arrives after a later one', async () => {
    const { ask, pending, answer, next, settle } = bench();
    ask('old');
    ask('new');
    next();
    pending.get('new')?.yes(2);
    await settle();
    pending.get('old')?.yes(1);
    await settle();
    expect(answer()).toEqual({ data: 2, key: 'colon' });
  });

  it('stays when a later query is refused, with the reason', async () => {
    const { ask, pending, answer, next, settle } = bench();
    ask('good');
    pending.get('good')?.yes(1);
    await settle();
    ask('bad');
    next();
    pending.get('bad')?.no(new Error('friction is -1'));
    await settle();
    expect(answer()).toMatchObject({ data: 1, error: 'friction is -1' });
    ask('good again');
    next();
    pending.get('good again')?.yes(3);
    await settle();
    expect(answer()).toEqual({ data: 3, key: 'colon' });
  });

  it('has the key of its query, which is asked again with another key', async () => {
    const { ask, setKey, pending, answer, next, settle } = bench();
    ask('same');
    pending.get('same')?.yes(1);
    await settle();
    expect(answer()).toEqual({ data: 1, key: 'colon' });
    setKey('posts');
    next();
    pending.get('same')?.no(new Error('no room'));
    await settle();
    expect(answer()).toEqual({ data: 1, error: 'no room', key: 'posts' });
  });

  it('stays while there is no query', async () => {
    const { ask, pending, answer, settle } = bench();
    ask('late');
    ask(undefined);
    pending.get('late')?.yes(1);
    await settle();
    expect(answer()).toEqual({});
  });

  it('is not reported after the end', async () => {
    const { ask, pending, answer, settle, close } = bench();
    ask('late');
    close();
    pending.get('late')?.yes(1);
    await settle();
    expect(answer()).toEqual({});
  });
});

describe('a problem', () => {
  it('has a text and a field', async () => {
    const problem = { detail: 'count must be from 2', field: 'count' };
    expect(await problemOf(Response.json(problem))).toEqual(problem);
  });

  it('has names in place of references', async () => {
    const detail = '"mine@0123456789abcdef" or other@fedcba9876543210, a@b.org';
    expect((await problemOf(Response.json({ detail }))).detail).toBe('"mine" or other, a@b.org');
  });

  it('is empty in the answer of a proxy', async () => {
    for (const body of ['<html>', 'null', '{"title":"Bad"}'])
      expect(await problemOf(new Response(body))).toEqual({});
  });
});
