import { describe, expect, it } from 'vitest';
import { pathLengthM, pathWords } from './plannerFacts';

const PATH: [number, number][] = [
  [0, 0],
  [0.3, 0.4],
  [0.3, 0.5],
];

describe('the path', () => {
  it('has the sum of the lengths of its parts', () => {
    expect(pathLengthM(PATH)).toBeCloseTo(0.6);
    expect(pathLengthM([])).toBe(0);
  });

  it('is searched only during a transport', () => {
    expect(pathWords(PATH, { code: 'transporting' })).toBe('60.0 cm');
    expect(pathWords([], { code: 'transporting' })).toBe('searching');
    expect(pathWords([], { code: 'approaching' })).toBe('none');
  });
});
