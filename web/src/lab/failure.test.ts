import { describe, expect, it } from 'vitest';
import type { MomentMessage, PhaseFact, TroubleFact } from '../net/protocol.gen';
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
import { phaseWords, troubleWords } from '../words/facts';
import { stateAt } from './testing';
import { eventAt, phaseOf, stoppedBy } from './testingFacts';

const LEG = stoppedBy('leg_steps', 150);
const GOAL = stoppedBy('goal_steps', 600);
const REACHED = stoppedBy('settle');
const WALLED_OFF = stoppedBy('walled_off');
const LIFTED_OFF = phaseOf('lifted_off');
const LOOP: Attempt = {
  controller: 'rl',
  end: LEG,
  trouble: { code: 'circling' },
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
    expect(causeOf({ ...LOOP, end: LIFTED_OFF })).toBe('The magnet lifted the bead off the table.');
  });

  it('is not the controller if the bead did not follow', () => {
    expect(causeOf({ ...LOOP, end: REACHED })).toBe(
      'The tool reached the goal, but the bead did not follow within 5 s.',
    );
  });
});

const TROUBLES: readonly (TroubleFact | null)[] = [
  { code: 'saddle' },
  { code: 'circling' },
  { code: 'walled_off' },
  null,
];
const CONTROLLERS = [
  ['rl', 'RL'],
  ['errt', 'ERRT'],
  ['attractor', 'Attractor'],
] as const;

describe.each(CONTROLLERS)('%s fails', (controller, name) => {
  describe.each(TROUBLES)('with the trouble %j', (trouble) => {
    const attempt = (end: PhaseFact): Attempt => ({ controller, end, trouble, map: 'colon' });

    it.each([
      [LEG, 150],
      [GOAL, 600],
    ])('at the limit %j', (end, steps) => {
      const words = phaseWords(end);
      const cause =
        trouble === null ? `${name} ${words}.` : `${troubleWords(name, trouble)} It ${words}.`;
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
        stoppedBy('tracker_lost'),
        'The tracker was lost for too long.',
        'Choose another goal when the tracker reports the bead again.',
        false,
      ],
      [LIFTED_OFF, 'The magnet lifted the bead off the table.', undefined, true],
    ])('with the end %j', (end, cause, advice, reset) => {
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
    trouble: { code: 'inside_obstacle', text: '' },
  });
  const first = failedAttempt(undefined, end, scene, undefined);

  it('stays as it was when the controller changes', () => {
    const changed = { ...end, controller: 'rl', trouble: null } as const;
    expect(failedAttempt(first, changed, scene, undefined)).toEqual(first);
    expect(first).toMatchObject({ controller: 'attractor', trouble: { code: 'inside_obstacle' } });
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
    expect(after({ phase: phaseOf('transporting') })).toBeUndefined();
    expect(after({ goal_m: null })).toBeUndefined();
    expect(after({ goal_m: null, phase: LIFTED_OFF })).toBeDefined();
  });
});

it('an event that ends an attempt tells its cause', () => {
  const overlay = { judgement: { trained_on: ['colon'] } } as MomentMessage['overlay'];
  const trouble = { code: 'circling', text: '' } as const;
  const moment = { controller: 'rl', trouble, overlay } as const;
  const what = { code: 'stopped', phase: LEG, text: '' } as const;
  expect(causeOfEvent({ what }, moment, LOOP.map)).toBe(causeOf(LOOP));
  const lifted = eventAt(1, 'lift_off', { code: 'lifted_off' });
  expect(causeOfEvent(lifted, moment, 'colon')).toContain('magnet');
  const reached = eventAt(1, 'reached', { code: 'reached' });
  expect(causeOfEvent(reached, moment, 'colon')).toBeUndefined();
});

it.each([
  [phaseOf('delivered'), false],
  [phaseOf('transporting'), false],
  [LIFTED_OFF, true],
  [WALLED_OFF, true],
])('%j is a failure: %s', (phase, failed) => {
  expect(isFailure(phase)).toBe(failed);
});
