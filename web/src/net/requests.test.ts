import { describe, expect, it } from 'vitest';
import { type Answer, Asker } from './requests';
import { problemText, withoutHashes } from './problem';

/** A server that answers when the test decides, and a clock that does not advance. */
function bench() {
  const pending = new Map<string, { yes: (data: number) => void; no: (reason: Error) => void }>();
  const answers: Answer<number>[] = [];
  let later: (() => void)[] = [];
  const asker = new Asker<number>(
    (question) => new Promise((yes, no) => pending.set(question, { yes, no })),
    (answer) => answers.push(answer),
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
  return { asker, pending, answers, next, settle };
}

describe('the asker', () => {
  it('sends the newest query of an interval', () => {
    const { asker, pending, next } = bench();
    for (const question of ['1', '2', '3']) asker.ask(question);
    next();
    expect([...pending.keys()]).toEqual(['1', '3']);
  });

  it('drops an answer that arrives after a later one', async () => {
    const { asker, pending, answers, next, settle } = bench();
    asker.ask('old');
    asker.ask('new');
    next();
    pending.get('new')?.yes(2);
    await settle();
    pending.get('old')?.yes(1);
    await settle();
    expect(answers).toEqual([{ data: 2 }]);
  });

  it('keeps the last answer when a query is refused, and reports the reason', async () => {
    const { asker, pending, answers, next, settle } = bench();
    asker.ask('good');
    pending.get('good')?.yes(1);
    await settle();
    asker.ask('bad');
    next();
    pending.get('bad')?.no(new Error('friction is -1'));
    await settle();
    expect(answers.at(-1)).toEqual({ data: 1, error: 'friction is -1' });
    asker.ask('good again');
    next();
    pending.get('good again')?.yes(3);
    await settle();
    expect(answers.at(-1)).toEqual({ data: 3 });
  });

  it('reports the key of the answered query', async () => {
    const { asker, pending, answers, next, settle } = bench();
    asker.ask('same', 'colon');
    pending.get('same')?.yes(1);
    await settle();
    expect(answers.at(-1)).toEqual({ data: 1, key: 'colon' });
    asker.ask('same', 'posts');
    next();
    pending.get('same')?.no(new Error('no room'));
    await settle();
    expect(answers.at(-1)).toEqual({ data: 1, error: 'no room', key: 'posts' });
  });

  it('does not report an answer after it was closed', async () => {
    const { asker, pending, answers, settle } = bench();
    asker.ask('late');
    asker.forget();
    pending.get('late')?.yes(1);
    await settle();
    expect(answers).toEqual([]);
  });
});

describe('the text of a refusal', () => {
  it('is its detail', () => {
    expect(problemText({ detail: 'count must be from 2', field: 'count' })).toMatch(/^count/);
    expect(problemText({ title: 'Bad' })).toBeUndefined();
    expect(problemText(undefined)).toBeUndefined();
  });

  it('has names in place of references', () => {
    expect(withoutHashes('"mine@0123456789abcdef" or other@fedcba9876543210')).toBe(
      '"mine" or other',
    );
    expect(withoutHashes('a@b.org')).toBe('a@b.org');
  });
});
