import { expect, it } from 'vitest';
import { columnsOf, type Points, readWords } from './series';

const line = (...values: [x: number, value: number][]): Points =>
  values.map(([x, value]) => [x, [null, null, value]]);
const BAND = { digits: 3, intervals: 'band' } as const;
const BARS = { digits: 0, suffix: ' %', intervals: 'bars' } as const;

it('has the places of all lines together', () => {
  const columns = columnsOf([line([200, 0.1], [100, 0.01]), line([100, 0.5], [300, 0.2])]);
  expect(columns[0]).toEqual([100, 200, 300]);
  expect(columns[3]).toEqual([0.01, 0.1, null]);
  expect(columns[6]).toEqual([0.5, null, 0.2]);
  expect(readWords(BAND, ['a', 'b'], columns, 0)).toBe('a 0.010, b 0.500');
  expect(readWords(BAND, ['a', 'b'], columns, 1)).toBe('a 0.100');
  expect(readWords(BAND, ['a'], columns, 2)).toBeUndefined();
});

it('says an interval that is drawn as a bar', () => {
  const columns = columnsOf([[[1, [57.2, 43.1, 50]]]]);
  expect(readWords(BARS, ['a'], columns, 0)).toBe('a 50 (43 to 57) %');
  expect(readWords({ ...BARS, intervals: 'band' }, ['a'], columns, 0)).toBe('a 50 %');
});
