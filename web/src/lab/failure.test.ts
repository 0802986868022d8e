import { describe, expect, it } from 'vitest';
import type { MomentMessage } from '../net/protocol.gen';
import { type Attempt, betterController, causeOf, causeOfEvent, isFailure } from './failure';

const LOOP: Attempt = {
  controller: 'rl',
  end: 'stopped: 150 steps without reaching the goal',
  trouble: 'going to and fro without getting nearer',
  map: 'colon-folds',
  trainedOn: ['colon'],
};

describe('the cause of a failure', () => {
  it('names the trouble, the limit and the foreign map', () => {
    expect(causeOf(LOOP)).toBe(
      'RL is going to and fro without getting nearer. It stopped: 150 steps without reaching the goal. It was not trained on this map.',
    );
  });

  it('does not blame the map that the policy was trained on', () => {
    expect(causeOf({ ...LOOP, map: 'colon' })).not.toContain('trained');
    expect(causeOf({ ...LOOP, trainedOn: undefined })).not.toContain('trained');
  });

  it('without a trouble is the limit', () => {
    const late = { ...LOOP, controller: 'errt' as const, trouble: null };
    expect(causeOf(late)).toBe('ERRT: 150 steps without reaching the goal.');
  });

  it('is the magnet after a lift-off', () => {
    expect(causeOf({ ...LOOP, end: 'lifted off' })).toContain('magnet');
  });
});

it('an event that ends an attempt tells its cause', () => {
  const overlay = { judgement: { trained_on: ['colon'] } } as MomentMessage['overlay'];
  const moment = { controller: 'rl', trouble: LOOP.trouble, overlay } as const;
  const stopped = { kind: 'stopped', text: LOOP.end } as const;
  expect(causeOfEvent(stopped, moment, LOOP.map)).toBe(causeOf(LOOP));
  const lifted = { kind: 'lift_off', text: 'lift-off: the bead jumped to the magnet' } as const;
  expect(causeOfEvent(lifted, moment, 'colon')).toContain('magnet');
  expect(causeOfEvent({ kind: 'reached', text: 'reached' }, moment, 'colon')).toBeUndefined();
});

it.each([
  ['delivered', false],
  ['transporting', false],
  ['lifted off', true],
  ['stopped: the goal is walled off', true],
])('“%s” is a failure: %s', (phase, failed) => {
  expect(isFailure(phase)).toBe(failed);
});

it('advises ERRT where it can do better', () => {
  expect(betterController(LOOP)).toBe('errt');
  expect(betterController({ ...LOOP, controller: 'errt' })).toBeUndefined();
  expect(betterController({ ...LOOP, end: 'stopped: the goal is walled off' })).toBeUndefined();
});
