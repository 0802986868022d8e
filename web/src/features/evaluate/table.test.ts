import { describe, expect, it } from 'vitest';
import { sceneOf } from '../../lab/testing';
import { setUpAgain } from './setUp';
import { cm, percentRange, ratio, reason, reportAddress, REPORTS, signed } from './table';
import { cellOf } from './testing';
import type { EvaluationFailure } from '../../net/protocol.gen';

const FAILURE: EvaluationFailure = {
  cell: 0,
  index: 7,
  // Larger than a JavaScript number can hold exactly.
  seed: '11400714819323198492',
  start_m: [-0.2, -0.3],
  goal_m: [0.1, -0.4],
  reached: false,
  outcome: 'stopped: 150 steps without reaching the goal',
  trouble: 'following a wall',
  refusal: null,
  steps: 150,
  disturbances: 0,
};

describe('text of a row', () => {
  it('has percentages, centimetres and the reason of a failure', () => {
    expect(percentRange([0.8333, 1])).toBe('83–100 %');
    expect(cm(0.0141)).toBe('1.4');
    expect(cm(null)).toBe('–');
    expect(reason({ ...FAILURE, refusal: 'a wall is ahead' })).toBe(
      'stopped: 150 steps without reaching the goal; following a wall; a wall is ahead',
    );
    expect(reason({ ...FAILURE, outcome: 'transporting', trouble: null })).toBe('transporting');
  });
});

describe('differences', () => {
  it('show their sign', () => {
    expect(signed(-10.5, 1)).toBe('−10.5');
    expect(signed(1.25, 1)).toBe('+1.3');
    expect(signed(0, 1)).toBe('0.0');
    expect(ratio(null)).toBe('–');
    expect(ratio(1.0432)).toBe('1.043');
  });
});

describe('files', () => {
  it('have addresses on the server', () => {
    expect(REPORTS.map((ending) => reportAddress('evaluation-3', ending))).toEqual([
      '/api/evaluations/evaluation-3/report.html',
      '/api/evaluations/evaluation-3/report.csv',
      '/api/evaluations/evaluation-3/report.json',
    ]);
  });
});

describe('setUpAgain', () => {
  const { defaults } = sceneOf('posts');

  it('requests exactly this trial', () => {
    const cell = cellOf({ map: 'colon', controller: 'attractor', disturbances: 3 });
    expect(setUpAgain(cell, FAILURE, defaults)).toEqual({
      type: 'load_scenario',
      map: 'colon',
      controller: 'attractor',
      disturbances: 3,
      seed: '11400714819323198492',
      start_m: [-0.2, -0.3],
      goal_m: [0.1, -0.4],
      parameters: defaults,
    });
  });

  it('leaves out missing values', () => {
    expect(setUpAgain(cellOf(), { ...FAILURE, goal_m: null }, defaults)).not.toHaveProperty(
      'goal_m',
    );
  });
});
