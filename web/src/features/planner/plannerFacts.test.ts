import { describe, expect, it } from 'vitest';
import { wayLengthM, wayWords } from './plannerFacts';

const WAY: [number, number][] = [
  [0, 0],
  [0.3, 0.4],
  [0.3, 0.5],
];

describe('the way', () => {
  it('is as long as its parts', () => {
    expect(wayLengthM(WAY)).toBeCloseTo(0.6);
    expect(wayLengthM([])).toBe(0);
  });

  it('is searched only while the bead is to be carried', () => {
    expect(wayWords(WAY, 'transporting')).toBe('60.0 cm');
    expect(wayWords([], 'transporting')).toBe('searching');
    expect(wayWords([], 'approaching')).toBe('none');
  });
});
