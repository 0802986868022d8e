import { describe, expect, it } from 'vitest';
import { episodesDone, episodesInAll, milestone, numberOf, stageWords, subject } from './progress';
import { isActive } from '../../lab/trainingStage';
import { cellOf, summaryOf } from './testing';

const TWO = summaryOf({
  cells: [cellOf({ done: 10, elapsed_s: 20 }), cellOf({ disturbances: 3, done: 4, elapsed_s: 12 })],
  rows_done: 1,
});

describe('progress', () => {
  it('is counted in episodes', () => {
    expect([episodesDone(TWO), episodesInAll(TWO)]).toEqual([14, 20]);
    expect(isActive(TWO)).toBe(true);
    expect(isActive({ ...TWO, stage: 'cancelled' })).toBe(false);
    expect(stageWords({ ...TWO, stage: 'waiting' })).toBe('waits');
  });
});

describe('words', () => {
  it('name controllers, maps and disturbances', () => {
    expect(numberOf('evaluation-12')).toBe('12');
    const query = { ...TWO.query, controllers: ['rl', 'errt'] as ('rl' | 'errt')[] };
    expect(subject({ ...TWO, query: { ...query, disturbances: [0, 3] } })).toBe(
      'RL, ERRT on posts; 0 and 3 disturbances; 10 per cell, seed 1',
    );
    expect(subject({ ...TWO, query: { ...TWO.query, disturbances: [1] } })).toBe(
      'RL on posts; 1 disturbance; 10 per cell, seed 1',
    );
    const mine = { ...TWO.query, rl_policy: 'mine@0123456789abcdef' };
    expect(subject({ ...TWO, query: mine })).toBe(
      'RL (mine) on posts; 0 disturbances; 10 per cell, seed 1',
    );
  });

  it('change at milestones only', () => {
    const at = (done: number) => milestone({ ...TWO, cells: [cellOf({ done })] });
    expect(at(0)).toBe(at(2));
    expect(at(3)).toBe('Evaluation 3: 25 % of the episodes, 1 of 1 rows.');
    expect(at(4)).toBe(at(3));
    expect(milestone({ ...TWO, stage: 'done', rows_done: 2 })).toBe(
      'Evaluation 3 is done: 2 of 2 rows.',
    );
    expect(milestone({ ...TWO, stage: 'failed', message: 'no camera' })).toContain('no camera');
    expect(milestone({ ...TWO, stage: 'cancelled' })).toContain('cancelled after 1 of 2');
    expect(milestone({ ...TWO, stage: 'waiting' })).toBe('Evaluation 3 waits.');
  });
});
