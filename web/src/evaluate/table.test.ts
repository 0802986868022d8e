import { describe, expect, it } from 'vitest';
import { sceneOf } from '../testing';
import { paperRow, wilson95 } from './paper';
import { setUpAgain } from './setUp';
import { cm, csv, decisionWords, fileName, json, percentRange, reason } from './table';
import { ROW, cellOf, reportOf } from './testing';
import type { EvaluationFailure } from '../protocol.gen';

const FAILURE: EvaluationFailure = {
  cell: 0,
  index: 7,
  // More than a number of JavaScript holds.
  seed: '11400714819323198492',
  start_m: [-0.2, -0.3],
  goal_m: [0.1, -0.4],
  reached: false,
  outcome: 'stopped: 150 steps without reaching the goal',
  trouble: 'follows a wall',
  refusal: null,
  steps: 150,
  disturbances: 0,
};

describe('text of a row', () => {
  it('is short', () => {
    expect(percentRange([0.8333, 1])).toBe('83–100 %');
    expect(cm(0.0141)).toBe('1.4');
    expect(cm(undefined)).toBe('–');
    expect(decisionWords(ROW)).toBe('2.3 · 7.5');
    expect(reason(FAILURE)).toBe('stopped: 150 steps without reaching the goal; follows a wall');
  });
});

describe('files', () => {
  it('hold the rows in full', () => {
    const [head, line, end] = csv([ROW], 5).split('\r\n');
    const columns = head?.split(',') ?? [];
    const values = line?.split(',') ?? [];
    expect(values).toHaveLength(columns.length);
    expect(end).toBe('');
    const value = (name: string) => values[columns.indexOf(name)];
    expect(value('tracking_error_mean_m')).toBe('0.0141');
    expect(value('successes_wilson95_low')).toBe('0.833');
    expect(value('wilson95_high')).toBe('0.982');
    expect(value('seed')).toBe('5');
    // Every field of a row has its column.
    expect(columns).toHaveLength(Object.values(ROW).flat().length + 1);
  });

  it('quote what would break a line', () => {
    expect(csv([{ ...ROW, map: 'a "b", c' }], 1)).toContain('errt,"a ""b"", c",3');
  });

  it('are named after what they hold', () => {
    expect(fileName(reportOf(), 'csv')).toBe('ferry-evaluation-3-seed-1.csv');
    expect(JSON.parse(json(reportOf()))).toEqual(reportOf());
  });
});

describe("the paper's numbers", () => {
  it('stand beside RL on the colon alone', () => {
    const calm = paperRow(cellOf({ map: 'colon' }));
    expect(calm).toMatchObject({ successes: 30, episodes: 30, tracking_error_max_y_m: 0.09 });
    expect(paperRow(cellOf({ map: 'colon', disturbances: 3 }))).toMatchObject({ successes: 29 });
    expect(paperRow(cellOf({ map: 'posts' }))).toBeUndefined();
    expect(paperRow(cellOf({ map: 'colon', controller: 'errt' }))).toBeUndefined();
    expect(paperRow(cellOf({ map: 'colon', disturbances: 1 }))).toBeUndefined();
  });

  it("have the server's intervals", () => {
    const [low, high] = wilson95(29, 30);
    expect(low).toBeCloseTo(0.83329, 4);
    expect(high).toBeCloseTo(0.99409, 4);
    expect(wilson95(30, 30)[1]).toBeCloseTo(1, 12);
  });
});

describe('setUpAgain', () => {
  const { defaults } = sceneOf('posts');

  it('asks for the very trial', () => {
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

  it('leaves out what the trial did not say', () => {
    expect(setUpAgain(cellOf(), { ...FAILURE, goal_m: null }, defaults)).not.toHaveProperty(
      'goal_m',
    );
  });
});
