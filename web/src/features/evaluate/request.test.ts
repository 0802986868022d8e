import { describe, expect, it } from 'vitest';
import { chooseControllers, estimate_s, PAPERS, queryOf, sizeWords } from './request';

const PAPERS_QUERY = {
  controllers: ['rl' as const],
  maps: ['colon'],
  disturbances: [0, 3],
  episodes: 30,
  seed: 1,
  rl_policy: 'auto',
  program: null,
  vary: [],
};

describe('queryOf', () => {
  it('contains the choices and the typed values', () => {
    expect(queryOf(PAPERS)).toEqual(PAPERS_QUERY);
  });

  it('names a policy for RL only', () => {
    const draft = { ...PAPERS, rl_policy: 'mine@0123456789abcdef' };
    expect(queryOf(draft)).toMatchObject({ rl_policy: draft.rl_policy });
    expect(queryOf({ ...draft, controllers: ['errt'] })).toMatchObject({ rl_policy: 'auto' });
  });

  it('names a program beside the controllers, or alone', () => {
    expect(queryOf({ ...PAPERS, program: 'mine' })).toMatchObject({
      controllers: ['rl', 'program'],
      program: 'mine',
    });
    expect(queryOf({ ...PAPERS, controllers: [], program: 'mine' })).toMatchObject({
      controllers: ['program'],
      program: 'mine',
    });
  });

  it('gives varied values in stored units', () => {
    const vary = [{ name: 'threshold_m', from: '1', to: '4', count: '4' }] as const;
    const made = queryOf({ ...PAPERS, vary });
    expect(made).toMatchObject({
      vary: [{ name: 'threshold_m', from: 0.01, to: 0.04, count: 4 }],
    });
    expect(sizeWords(made)).toBe('8 cells, 240 episodes');
  });
});

describe('chooseControllers', () => {
  it.each<[string[], string, string[], string]>([
    [['errt', 'rl'], '', ['rl', 'errt'], ''],
    [['rl', 'mine'], '', ['rl'], 'mine'],
    [['rl', 'mine', 'other'], 'mine', ['rl'], 'other'],
    [['mine'], 'mine', [], 'mine'],
  ])('%o after %o', (chosen, last, controllers, program) => {
    expect(chooseControllers(chosen, last)).toEqual({ controllers, program });
  });
});

describe('the size', () => {
  it('is given in cells and episodes', () => {
    expect(sizeWords(PAPERS_QUERY)).toBe('2 cells, 60 episodes');
    expect(sizeWords({ ...PAPERS_QUERY, disturbances: [0], episodes: 1 })).toBe(
      '1 cell, 1 episode',
    );
    for (const wrong of [{ maps: [] }, { episodes: NaN }]) {
      expect(sizeWords({ ...PAPERS_QUERY, ...wrong })).toBeUndefined();
    }
  });

  it('has a duration from the pace of each controller', () => {
    expect(estimate_s(PAPERS_QUERY, () => NaN)).toBeNaN();
    const pace = (work: string): number => (work === 'evaluation_rl' ? 0.5 : 4);
    expect(estimate_s(PAPERS_QUERY, pace)).toBe(60 * 0.5);
    expect(estimate_s({ ...PAPERS_QUERY, controllers: ['rl', 'errt'] }, pace)).toBe(60 * 4.5);
  });
});
