import { describe, expect, it } from 'vitest';
import { type Answer, Asker } from './requests';
import { problemText } from './problem';

/** A server whose answers come when the test says so, and a clock on which no time passes. */
function bench() {
  const asked = new Map<string, { yes: (data: number) => void; no: (reason: Error) => void }>();
  const told: Answer<number>[] = [];
  let later: (() => void)[] = [];
  const asker = new Asker<number>(
    (question) => new Promise((yes, no) => asked.set(question, { yes, no })),
    (answer) => told.push(answer),
    undefined,
    {
      nowMs: () => 0,
      later: (action) => {
        later.push(action);
      },
    },
  );
  const next = (): void => {
    const due = later;
    later = [];
    for (const action of due) action();
  };
  const settle = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));
  return { asker, asked, told, next, settle };
}

describe('the asker', () => {
  it('asks the newest question of an interval', () => {
    const { asker, asked, next } = bench();
    for (const question of ['1', '2', '3']) asker.ask(question);
    next();
    expect([...asked.keys()]).toEqual(['1', '3']);
  });

  it('drops an answer that a later one has overtaken', async () => {
    const { asker, asked, told, next, settle } = bench();
    asker.ask('old');
    asker.ask('new');
    next();
    asked.get('new')?.yes(2);
    await settle();
    asked.get('old')?.yes(1);
    await settle();
    expect(told).toEqual([{ data: 2 }]);
  });

  it('keeps the last answer when a question is refused, and says why', async () => {
    const { asker, asked, told, next, settle } = bench();
    asker.ask('good');
    asked.get('good')?.yes(1);
    await settle();
    asker.ask('bad');
    next();
    asked.get('bad')?.no(new Error('friction is -1'));
    await settle();
    expect(told.at(-1)).toEqual({ data: 1, error: 'friction is -1' });
    asker.ask('good again');
    next();
    asked.get('good again')?.yes(3);
    await settle();
    expect(told.at(-1)).toEqual({ data: 3 });
  });

  it('says with which key the question was asked that it has an answer to', async () => {
    const { asker, asked, told, next, settle } = bench();
    asker.ask('same', 'colon');
    asked.get('same')?.yes(1);
    await settle();
    expect(told.at(-1)).toEqual({ data: 1, key: 'colon' });
    asker.ask('same', 'posts');
    next();
    asked.get('same')?.no(new Error('no room'));
    await settle();
    expect(told.at(-1)).toEqual({ data: 1, error: 'no room', key: 'posts' });
  });

  it('says nothing to those who are gone', async () => {
    const { asker, asked, told, settle } = bench();
    asker.ask('late');
    asker.forget();
    asked.get('late')?.yes(1);
    await settle();
    expect(told).toEqual([]);
  });
});

describe('a refusal', () => {
  it('is told by its detail', () => {
    expect(problemText({ detail: 'count must be from 2', field: 'count' })).toMatch(/^count/);
    expect(problemText({ title: 'Bad' })).toBeUndefined();
    expect(problemText(undefined)).toBeUndefined();
  });
});
