import { describe, expect, it } from 'vitest';
import {
  chooseControllers,
  estimate_s,
  faultsOf,
  PAPERS,
  queryOf,
  sizeWords,
  toggled,
} from './request';
import { cellOf, summaryOf } from './testing';

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
    expect(queryOf(PAPERS)).toEqual({ query: PAPERS_QUERY });
    // The server checks the limits.
    expect(queryOf({ ...PAPERS, episodes: '0' })).toEqual({
      query: { ...PAPERS_QUERY, episodes: 0 },
    });
  });

  it('names a policy for RL only', () => {
    const draft = { ...PAPERS, rl_policy: 'mine@0123456789abcdef' };
    expect(queryOf(draft)).toMatchObject({ query: { rl_policy: draft.rl_policy } });
    expect(queryOf({ ...draft, controllers: ['errt'] })).toMatchObject({
      query: { rl_policy: 'auto' },
    });
  });

  it('names a program beside the controllers, or alone', () => {
    expect(queryOf({ ...PAPERS, program: 'mine' })).toMatchObject({
      query: { controllers: ['rl', 'program'], program: 'mine' },
    });
    expect(queryOf({ ...PAPERS, controllers: [], program: 'mine' })).toMatchObject({
      query: { controllers: ['program'], program: 'mine' },
    });
  });

  it('gives varied values in stored units', () => {
    const vary = [{ name: 'threshold_m', from: '1', to: '4', count: '4' }] as const;
    const made = queryOf({ ...PAPERS, vary });
    expect(made).toMatchObject({
      query: { vary: [{ name: 'threshold_m', from: 0.01, to: 0.04, count: 4 }] },
    });
    expect('query' in made && sizeWords(made.query)).toBe('8 cells, 240 episodes');
    for (const wrong of [{ from: '' }, { to: 'far' }, { count: '2.5' }]) {
      const one = queryOf({ ...PAPERS, vary: [{ ...vary[0], ...wrong }] });
      expect(one).toHaveProperty('faults.vary');
    }
  });

  it('reports every field that is empty or not a number', () => {
    const bad = {
      ...PAPERS,
      controllers: [],
      maps: [],
      disturbances: [],
      episodes: '',
      seed: '1.5',
    };
    const made = queryOf(bad);
    expect('faults' in made && Object.keys(made.faults).sort()).toEqual(
      ['controllers', 'disturbances', 'episodes', 'maps', 'seed'].sort(),
    );
    for (const seed of ['-1', '9007199254740993', '1e3', '']) {
      expect(queryOf({ ...PAPERS, seed })).toHaveProperty('faults.seed');
    }
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

describe('faultsOf', () => {
  it('shows a refusal at its field', () => {
    expect(faultsOf({ detail: 'no', field: 'maps[1]' })).toEqual({ maps: 'no' });
    expect(faultsOf({ detail: 'gone', field: 'program' })).toEqual({ controllers: 'gone' });
    expect(faultsOf({ detail: 'no', field: 'episodes' })).toEqual({ episodes: 'no' });
  });

  it('shows other refusals at the form', () => {
    expect(faultsOf({ detail: 'full' })).toEqual({ form: 'full' });
    expect(faultsOf({ detail: 'no', field: 'Host' })).toEqual({ form: 'no' });
  });
});

describe('toggled', () => {
  it('keeps the given order', () => {
    expect(toggled(['a', 'b', 'c'], ['c'], 'a', true)).toEqual(['a', 'c']);
    expect(toggled(['a', 'b', 'c'], ['c', 'a'], 'c', false)).toEqual(['a']);
    expect(toggled(['a', 'b'], ['a'], 'a', true)).toEqual(['a']);
  });
});

describe('the size', () => {
  it('is given in cells and episodes', () => {
    expect(sizeWords(PAPERS_QUERY)).toBe('2 cells, 60 episodes');
    expect(sizeWords({ ...PAPERS_QUERY, disturbances: [0], episodes: 1 })).toBe(
      '1 cell, 1 episode',
    );
  });

  it('has no duration before a measurement', () => {
    expect(estimate_s(PAPERS_QUERY, [])).toBeUndefined();
    expect(estimate_s(PAPERS_QUERY, [summaryOf()])).toBeUndefined();
  });

  it('is estimated from the most similar cell', () => {
    const measured = summaryOf({
      cells: [
        cellOf({ done: 10, elapsed_s: 5 }),
        cellOf({ disturbances: 3, done: 10, elapsed_s: 20 }),
        cellOf({ controller: 'errt', map: 'colon', done: 10, elapsed_s: 900 }),
      ],
    });
    expect(estimate_s(PAPERS_QUERY, [measured])).toBe(30 * 0.5 + 30 * 2);
  });
});
