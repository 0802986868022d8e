import { describe, expect, it } from 'vitest';
import type { ProgramStanding } from '../../net/protocol.gen';
import { standingWords } from './words';

const program: ProgramStanding = {
  name: 'mine',
  is_connected: true,
  answers: 0,
  missed: 0,
  latency_s: null,
};

describe('a program', () => {
  it.each<[Partial<ProgramStanding>, string]>([
    [{}, 'mine has not been asked yet.'],
    [{ latency_s: 0.0042, answers: 3 }, 'mine answers in 4 ms.'],
    [{ latency_s: 0.09, missed: 1 }, 'mine answers in 90 ms; 1 step without a usable answer.'],
    [{ latency_s: 0.09, is_connected: false }, 'mine is not connected: the arm holds until it is.'],
  ])('%o', (change, words) => {
    expect(standingWords({ ...program, ...change })).toBe(words);
  });
});
