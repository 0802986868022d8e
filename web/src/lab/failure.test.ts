import { describe, expect, it } from 'vitest';
import type { MomentMessage } from '../net/protocol.gen';
import {
  adviceOf,
  type Attempt,
  betterController,
  causeOf,
  causeOfEvent,
  failedAttempt,
  furtherSteps,
  isFailure,
  needsReset,
} from './failure';
import { stateAt } from './testing';

const LEG = 'stopped: 150 steps without reaching the goal';
const GOAL = 'stopped: 600 steps without delivering';
const REACHED = 'stopped: reached, but the bead did not follow within 5 s';
const WALLED_OFF = 'stopped: the goal is walled off';
const LOOP: Attempt = {
  controller: 'rl',
  end: LEG,
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
    expect(causeOf({ ...LOOP, controller: 'errt' })).not.toContain('trained');
  });

  it('is the magnet after a lift-off', () => {
    expect(causeOf({ ...LOOP, end: 'lifted off' })).toBe(
      'The magnet lifted the bead off the table.',
    );
  });

  it('is not the controller if the bead did not follow', () => {
    expect(causeOf({ ...LOOP, end: REACHED })).toBe(
      'The tool reached the goal, but the bead did not follow within 5 s.',
    );
  });
});

/** Every trouble of `server/core/control/transport.rs`, and none. */
const TROUBLES: readonly [string | null, string][] = [
  ['stuck where the flow ends before the goal', 'is stuck where the flow ends before the goal.'],
  ['going to and fro without getting nearer', 'is going to and fro without getting nearer.'],
  ['too near a wall to go on', 'is too near a wall to go on.'],
  ['blocked: each step is refused', 'is blocked: each step is refused.'],
  ['no path found yet', 'has found no path yet.'],
  ['walled off', 'found no path: the goal is walled off.'],
  [null, ''],
];
const CONTROLLERS = [
  ['rl', 'RL'],
  ['errt', 'ERRT'],
  ['attractor', 'Attractor'],
] as const;

describe.each(CONTROLLERS)('%s fails', (controller, name) => {
  describe.each(TROUBLES)('with the trouble “%s”', (trouble, words) => {
    const attempt = (end: string): Attempt => ({ controller, end, trouble, map: 'colon' });

    it.each([
      [LEG, 150],
      [GOAL, 600],
    ])('at the limit “%s”', (end, steps) => {
      const cause = trouble === null ? `${name} ${end}.` : `${name} ${words} It ${end}.`;
      expect(causeOf(attempt(end))).toBe(cause);
      expect(furtherSteps(attempt(end))).toBe(steps);
      expect(betterController(attempt(end))).toBe(controller === 'errt' ? undefined : 'errt');
      expect(adviceOf(attempt(end))).toBeUndefined();
      expect(needsReset(attempt(end))).toBe(false);
    });

    it.each([
      [
        REACHED,
        'The tool reached the goal, but the bead did not follow within 5 s.',
        'Choose another goal, or drag the bead to this one.',
        false,
      ],
      [WALLED_OFF, `${name} found no path: the goal is walled off.`, 'Choose another goal.', false],
      [
        'stopped: the tracker was lost for too long',
        'The tracker was lost for too long.',
        'Choose another goal when the tracker reports the bead again.',
        false,
      ],
      ['lifted off', 'The magnet lifted the bead off the table.', undefined, true],
    ])('with the end “%s”', (end, cause, advice, reset) => {
      expect(causeOf(attempt(end))).toBe(cause);
      expect(furtherSteps(attempt(end)), 'further steps would only repeat it').toBeUndefined();
      expect(betterController(attempt(end))).toBeUndefined();
      expect(adviceOf(attempt(end))).toBe(advice);
      expect(needsReset(attempt(end))).toBe(reset);
    });
  });
});

describe('a failed attempt', () => {
  const scene = { map: 'colon', trial: 3 };
  const end = stateAt(900, {
    phase: LEG,
    goal_m: [0.1, -0.3, 0],
    steps: 150,
    controller: 'attractor',
    trouble: 'too near a wall to go on',
  });
  const first = failedAttempt(undefined, end, scene, undefined);

  it('stays as it was when the controller changes', () => {
    const changed = { ...end, controller: 'rl', trouble: null } as const;
    expect(failedAttempt(first, changed, scene, undefined)).toEqual(first);
    expect(first).toMatchObject({ controller: 'attractor', trouble: 'too near a wall to go on' });
  });

  it('learns on what the policy was trained when that comes later, but only once', () => {
    const second = failedAttempt(first, end, scene, ['colon']);
    expect(second?.trainedOn).toEqual(['colon']);
    expect(failedAttempt(second, end, scene, ['posts'])?.trainedOn).toEqual(['colon']);
  });

  it.each([
    ['trial', { map: 'colon', trial: 4 }, {}],
    ['goal', scene, { goal_m: [0.2, -0.3, 0] as [number, number, number] }],
    ['number of steps', scene, { steps: 300 }],
    ['end', scene, { phase: GOAL }],
  ])('is another one with another %s', (_, otherScene, change) => {
    const other = { ...end, controller: 'rl' as const, trouble: null, ...change };
    const next = failedAttempt(first, other, otherScene, undefined);
    expect(next?.key).not.toBe(first?.key);
    expect(next?.controller).toBe('rl');
  });

  it('is over when the bead moves on or the goal is removed', () => {
    const after = (change: object): unknown =>
      failedAttempt(first, { ...end, ...change }, scene, undefined);
    expect(after({ phase: 'transporting' })).toBeUndefined();
    expect(after({ goal_m: null })).toBeUndefined();
    expect(after({ goal_m: null, phase: 'lifted off' })).toBeDefined();
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
  [WALLED_OFF, true],
])('“%s” is a failure: %s', (phase, failed) => {
  expect(isFailure(phase)).toBe(failed);
});
