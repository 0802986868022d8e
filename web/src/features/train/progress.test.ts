import { describe, expect, it } from 'vitest';
import { isActive, milestone, shareWords, stageSentence, updateWords } from './progress';
import { summaryOf } from './testing';

const EXAMINED = {
  episodes: 1000,
  reached: 986,
  collided: 10,
  timed_out: 4,
  reached_wilson95: [0.977, 0.992] as [number, number],
};

describe('a training', () => {
  it('says how much is done and left', () => {
    expect(updateWords(summaryOf())).toBe('1000 of 4000 updates');
    expect(stageSentence(summaryOf(), [])).toBe('500 episodes so far, about 3 min left.');
    expect(stageSentence(summaryOf({ left_s: null }), [])).toBe('500 episodes so far.');
  });

  it('says what it waits for', () => {
    const waiting = summaryOf({ id: 'training-3', stage: 'waiting' });
    const ended = summaryOf({ stage: 'done' });
    expect(stageSentence(waiting, [summaryOf(), ended])).toBe('Waits until my-posts is finished.');
    expect(stageSentence(waiting, [ended])).toContain('such as an evaluation');
  });

  it('says how it ended', () => {
    const done = summaryOf({ stage: 'done', examined: EXAMINED });
    expect(shareWords(EXAMINED)).toBe('986 of 1000');
    expect(stageSentence(done, [])).toContain('986 of 1000 episodes');
    expect(stageSentence(summaryOf({ stage: 'failed', message: 'No GPU.' }), [])).toBe('No GPU.');
    expect(isActive(done)).toBe(false);
    expect(isActive(summaryOf({ stage: 'paused' }))).toBe(true);
  });

  it('is announced at each quarter', () => {
    expect(milestone(summaryOf({ updates: 999 }), [])).toBe('my-posts: 0 % of the updates.');
    expect(milestone(summaryOf(), [])).toBe('my-posts: 25 % of the updates.');
    expect(milestone(summaryOf({ stage: 'paused' }), [])).toBe(
      'my-posts: Paused after 1000 updates.',
    );
  });
});
