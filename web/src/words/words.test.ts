import { describe, expect, it } from 'vitest';
import type { RefusalCode } from '../net/protocol.gen';
import { eventWords } from './events';
import { holdWords, phaseWords, reasonWords, troubleWords } from './facts';
import { refusalWords } from './refusals';

// That every code has words is checked by the compiler: each table is a Record over the codes, and each switch returns.

describe('facts', () => {
  it('have the numbers of their values', () => {
    expect(phaseWords({ code: 'stopped', by: 'leg_steps', steps: 150 })).toBe(
      'stopped: 150 steps without reaching the goal',
    );
    expect(reasonWords({ code: 'lost', error_m: 0.155, threshold_m: 0.1 })).toBe(
      'bead lost: more than T = 10.0 cm',
    );
    expect(troubleWords('ERRT', { code: 'walled_off' })).toBe(
      'ERRT found no path: the goal is walled off.',
    );
    expect(holdWords({ code: 'obstacle', x_m: 0.1, y_m: -0.3 })).toBe(
      'the camera sees an obstacle on the step, at (0.100, −0.300) m',
    );
  });
});

describe('events', () => {
  it('say what has happened', () => {
    expect(eventWords({ code: 'kicked', impulse_n_s: 0.0004 })).toBe(
      'disturbed: a kick of 0.40 mN·s',
    );
    const fact = { code: 'lost', error_m: 0.155, threshold_m: 0.1, text: '' } as const;
    expect(eventWords({ code: 'took_over', sub_controller: 1, reason: fact })).toBe(
      'sub-controller 1 takes over: bead lost: 15.5 cm away, more than T = 10.0 cm',
    );
  });
});

describe('a refused command', () => {
  const refused = (code: RefusalCode, values = {}, field?: string): string =>
    refusalWords({ code, values, detail: 'English', ...(field === undefined ? {} : { field }) });
  it('names the field and the value', () => {
    expect(refused('in_wall', { x_m: 0.1, y_m: -0.3 })).toMatch(
      /^\(0\.100, −0\.300\) m is in a wall/,
    );
    expect(refused('in_wall', { x_m: 0.1, y_m: -0.3 }, 'goal')).toBe('A wall is there.');
    expect(refused('out_of_reach', {}, 'goal')).toBe('The arm cannot go there.');
    expect(refused('out_of_range', { value: 99, allowed: '0.125 to 64' }, 'factor')).toBe(
      'factor is 99, it must be 0.125 to 64.',
    );
    expect(refused('not_you', { controller: 'errt' })).toContain('ERRT');
  });
  it('shows what only the server can say', () => {
    expect(refused('bad_case')).toBe('English');
  });
});
