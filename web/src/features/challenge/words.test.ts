import { describe, expect, it } from 'vitest';
import type { AttemptStanding, ChallengeReport, GhostMessage } from '../../net/protocol.gen';
import { challengeTitle, lossWords, seedFault, sumWords, verdict } from './words';

const ATTEMPT: AttemptStanding = {
  walls: 2,
  lost_beads: 0,
  total_s: 20.4,
  is_delivered: true,
  is_time_up: false,
  void: null,
};
const ghost = (controller: GhostMessage['controller'], total_s: number | null): GhostMessage => ({
  controller,
  player: null,
  score: null,
  total_s,
  trace: { tool_m: [], bead_m: [], mishaps: [] },
});

describe('a challenge', () => {
  it('has a title', () => {
    expect(challengeTitle('easy-2026-11-26')).toBe('Easy · 2026-11-26');
  });

  it.each([
    ['anna-7b', true],
    ['', false],
    ['Anna', false],
    ['a'.repeat(25), false],
  ])('takes the seed “%s”: %s', (seed, isFine) => {
    expect(seedFault(seed) === undefined).toBe(isFine);
  });
});

describe('an attempt', () => {
  it('is explained as a sum', () => {
    const rules = { wall_s: 1, lost_bead_s: 5 } as ChallengeReport;
    expect(sumWords(ATTEMPT, rules)).toBe(
      '18.4 s to deliver + 2 wall stops × 1 s + 0 lost beads × 5 s = 20.4 s',
    );
  });

  it.each([
    [[15, 21, null], 'You beat ERRT and Attractor; RL was faster.'],
    [[21, 22, null], 'You beat RL, ERRT and Attractor.'],
    [[15, 20.4, 10], 'RL, ERRT and Attractor were faster.'],
  ])('is compared with %j', ([rl = null, errt = null, attractor = null], words) => {
    const ghosts = {
      sample_s: 0.2,
      ghosts: [ghost('rl', rl), ghost('errt', errt), ghost('attractor', attractor)],
    };
    expect(verdict(ATTEMPT, undefined, ghosts)).toBe(words);
  });

  it('that was not delivered says how far the goal was', () => {
    const late = { ...ATTEMPT, is_delivered: false, is_time_up: true };
    const report = {
      challenge: '',
      trace: { tool_m: [], bead_m: [], mishaps: [] },
      remaining_m: 0.234,
      loss: null,
      compared_with: null,
      attempt: null,
    };
    expect(verdict(late, report, undefined)).toBe('Time is up. The bead still had 23 cm to go.');
  });

  it('says where time was lost and why', () => {
    const loss = {
      from_tick: 500,
      to_tick: 1000,
      place_m: [0, 0] as [number, number],
      lost_s: 2.5,
      walls: 2,
      lost_beads: 1,
      disturbances: 0,
    };
    expect(lossWords(loss, 'rl', 0.008)).toBe(
      'Most time was lost from 4.0 s to 8.0 s: 2.5 s more than RL needed for this part of the way. In this time a wall stopped the magnet twice and the bead was lost once.',
    );
    const idle = { ...loss, walls: 0, lost_beads: 0 };
    expect(lossWords(idle, null, 0.008)).toContain('the magnet waited');
  });
});
