import { describe, expect, it } from 'vitest';
import {
  intervalWords,
  isActive,
  milestone,
  progressWords,
  shareWords,
  stageSentence,
  updateWords,
} from './trainingStage';
import { trainingOf } from './testing';
import { jobOf } from './testingJobs';

const EXAMINED = {
  episodes: 1000,
  reached: 986,
  collided: 10,
  timed_out: 4,
  reached_wilson95: [0.977, 0.992] as [number, number],
  all_pairs: false,
};

describe('a training', () => {
  it('says how much is done and left', () => {
    expect(updateWords(trainingOf())).toBe('1000 of 4000 updates');
    expect(stageSentence(trainingOf(), undefined)).toBe('500 episodes so far, about 3 min left.');
    expect(stageSentence(trainingOf({ left_s: null }), undefined)).toBe('500 episodes so far.');
    expect(progressWords(trainingOf())).toBe('learns, 25 %, about 3 min left');
    expect(progressWords(trainingOf({ left_s: null }))).toBe('learns, 25 %');
    expect(progressWords(trainingOf({ stage: 'images' }))).toBe('takes images');
  });

  it('says what it waits for', () => {
    const waiting = trainingOf({ stage: 'waiting' });
    const job = jobOf({ stage: 'waiting', before: 2, starts_in_s: 200 });
    expect(stageSentence(waiting, job)).toBe('Waits for 2 jobs before it, about 4 min.');
    expect(stageSentence(waiting, undefined)).toBe('Waits.');
  });

  it('says how it ended', () => {
    const done = trainingOf({ stage: 'done', examined: EXAMINED });
    expect(shareWords(EXAMINED)).toBe('986 of 1000');
    expect(intervalWords(EXAMINED)).toBe('95 % interval: 97.7 to 99.2 %');
    expect(stageSentence(done, undefined)).toContain(
      '986 of 1000 episodes with random starts and goals',
    );
    const pairs = { ...EXAMINED, episodes: 3116, reached: 3115, all_pairs: true };
    expect(stageSentence({ ...done, examined: pairs }, undefined)).toBe(
      'It reaches the goal from 99 % of all pairs of cells (3115 of 3116).',
    );
    expect(intervalWords(pairs)).toBe('on all pairs');
    expect(stageSentence(trainingOf({ stage: 'failed', message: 'No GPU.' }), undefined)).toBe(
      'No GPU.',
    );
    expect(isActive(done)).toBe(false);
    expect(isActive(trainingOf({ stage: 'paused' }))).toBe(true);
  });

  it('is announced at each quarter', () => {
    expect(milestone(trainingOf({ updates: 999 }), undefined)).toBe(
      'my-posts: 0 % of the updates.',
    );
    expect(milestone(trainingOf(), undefined)).toBe('my-posts: 25 % of the updates.');
    expect(milestone(trainingOf({ stage: 'paused' }), undefined)).toBe(
      'my-posts: Paused after 1000 updates.',
    );
  });
});
