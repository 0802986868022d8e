import { describe, expect, it } from 'vitest';
import type { EvaluationCell, Row } from '../../net/protocol.gen';
import { gridOf, MEASURES, picturesOf, pointsOf } from './robustness';
import { cellOf, ROW } from './testing';
import { shown, variedWords } from './varied';

const at = (controller: 'errt' | 'rl', ...values: [string, number][]): EvaluationCell =>
  cellOf({ controller, varied: values.map(([name, value]) => ({ name, value })) });
const delivered = (count: number): Row => ({ ...ROW, delivered: count, episodes: 10 });

describe('one parameter', () => {
  const cells = [
    at('errt', ['threshold_m', 0.02]),
    at('rl', ['threshold_m', 0.02]),
    at('errt', ['threshold_m', 0.01]),
    at('rl', ['threshold_m', 0.01]),
  ];

  it('has a line for each controller, with the rows so far', () => {
    const [picture] = picturesOf(cells, [delivered(5), delivered(8), delivered(1)]);
    if (!picture || !MEASURES[0]) throw new Error('a picture');
    expect(picture.lines.map(({ label, points }) => [label, points.length])).toEqual([
      ['ERRT', 2],
      ['RL', 1],
    ]);
    expect(pointsOf(MEASURES[0], picture)).toEqual([
      [
        [2, [expect.any(Number), expect.any(Number), 50]],
        [1, [expect.any(Number), expect.any(Number), 10]],
      ],
      [[2, [expect.any(Number), expect.any(Number), 80]]],
    ]);
  });

  it('leaves out errors without an interval', () => {
    const row = { ...delivered(5), tracking_error_mean95_m: null };
    const [picture] = picturesOf(cells, [row]);
    if (!picture || !MEASURES[1]) throw new Error('a picture');
    expect(pointsOf(MEASURES[1], picture)).toEqual([[[2, [null, null, null]]], []]);
  });
});

it('two parameters have a grid, the largest value of the first one on top', () => {
  const cells = [1, 2].flatMap((up) =>
    [3, 4].map((right) => at('rl', ['errt_ways', up], ['obstacle_level', right])),
  );
  const [picture] = picturesOf(cells, [1, 2, 3, 4].map(delivered));
  const line = picture?.lines[0];
  if (!picture || !line) throw new Error('a picture');
  expect(gridOf(picture, line).map((row) => row.map((one) => one?.delivered))).toEqual([
    [3, 4],
    [1, 2],
  ]);
});

it('values are in the words of the page', () => {
  expect(shown('threshold_m', 0.025)).toBe(2.5);
  expect(variedWords([{ name: 'friction', value: 0.1 }])).toMatch(/0\.1$/);
  expect(variedWords([])).toBe('');
  expect(picturesOf([cellOf()], [ROW])).toEqual([]);
});
