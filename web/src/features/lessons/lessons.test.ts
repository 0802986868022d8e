import { describe, expect, it } from 'vitest';
import { sceneOf, stateAt } from '../../lab/testing';
import type { Examination } from '../../net/protocol.gen';
import { type ExperimentLesson, isTraining, isTrainingLesson, tasksOf } from './lesson';
import { GROUPS, LESSONS } from './lessons';
import { progressFrom } from './progress';
import { startTrack, type Track } from './track';

const START = startTrack({
  scene: sceneOf('posts'),
  state: stateAt(0),
  overlay: undefined,
  marks: [],
});

function track(change: Partial<Track>): Track {
  return { ...START, runGoal_m: GOAL_M, ...change };
}

function lesson(id: string): ExperimentLesson {
  const found = LESSONS.find((one) => one.id === id);
  if (!found || isTrainingLesson(found)) throw new Error(`no lesson ${id}`);
  return found;
}

const examined = (reached: number): Examination => ({
  episodes: 1000,
  reached,
  collided: 0,
  timed_out: 1000 - reached,
  reached_wilson95: [0, 1],
  all_pairs: false,
});

const GOAL_M = [0.2, -0.36] as const;
/** Where *Send it back* places the goal. */
const BACK_M = [0.19, -0.28] as const;

const deliveryAt = (time_s: number, goal_m: readonly [number, number] = GOAL_M, plans = 0) => ({
  time_s,
  goal_m,
  plans,
});

const delivered = (time_s: number): Partial<Track> => ({
  deliveries: [deliveryAt(time_s)],
});

/** A delivery to the goal after 13 plans, and to the start after so many. */
const thereAndBack = (plans: number): Partial<Track> => ({
  deliveries: [deliveryAt(10, GOAL_M, 13), deliveryAt(20, BACK_M, plans)],
});

describe('every lesson', () => {
  it.each(LESSONS.map((one) => [one.title, one] as const))('%s is complete', (_, one) => {
    const ids = Object.keys(one.choices);
    expect(ids.length).toBeGreaterThanOrEqual(2);
    expect(ids.length).toBeLessThanOrEqual(4);
    expect(one.paper).toMatch(/^(Section [IV]+|Not in the paper)/);
    // For any measurement, the outcome is one of the choices, and there are facts.
    if (isTrainingLesson(one)) {
      const examinations = one.runs.map(() => examined(500));
      expect(ids).toContain(one.outcome(...examinations));
      return;
    }
    const tracks = one.runs.map(() => START);
    expect(ids).toContain(one.outcome(...tracks));
    expect(one.facts(...tracks).length).toBeGreaterThan(0);
    for (const run of one.runs) {
      expect(tasksOf(run).length).toBeGreaterThan(1);
      // No task is done at the start.
      expect(tasksOf(run).filter((task) => task.done(START))).toEqual([]);
    }
  });

  it('has a unique id', () => {
    expect(new Set(LESSONS.map(({ id }) => id)).size).toBe(LESSONS.length);
  });
});

it.each([
  ['lose', 0],
  ['chatter', 1],
] as const)('%s counts no delivery from before the fetch', (id, run) => {
  const last = lesson(id).runs[run]?.tasks.at(-1);
  const before = { losses: 1, lostAt_s: 12, fetchedAt_s: 14 };
  expect(last?.done(track({ ...before, ...delivered(10) }))).toBe(false);
  expect(last?.done(track({ ...before, fetchedAt_s: undefined, ...delivered(13) }))).toBe(false);
  expect(last?.done(track({ ...before, ...delivered(20) }))).toBe(true);
});

it.each([
  ['the goal, and again after a push', [GOAL_M, GOAL_M], [true, false]],
  ['the start, before the goal', [BACK_M], [false, false]],
  ['the goal and the start', [GOAL_M, BACK_M], [true, true]],
  ['another place of the map', [[0.1, -0.4]], [false, false]],
] as const)('of the way there and back, a delivery to %s counts', (_, goals, done) => {
  const tasks = lesson('errt').runs[0].tasks.slice(1);
  const deliveries = goals.map((goal_m, index) => deliveryAt(10 * (index + 1), goal_m));
  expect(tasks.map((task) => task.done(track({ deliveries })))).toEqual(done);
});

it('groups all lessons, each once, and begins with the magnet', () => {
  expect(GROUPS.map(({ title }) => title)).toEqual([
    'The magnet',
    'Switching',
    'Carrying',
    'Training',
  ]);
  expect(LESSONS.slice(0, 2).map(({ id }) => id)).toEqual(['magnet', 'lift-off']);
});

/** Distances on the table are in cm: mm are for heights, speeds, waves and errors of the tracker. */
it.each(LESSONS.map((one) => [one.title, one] as const))(
  '%s has one unit for a distance',
  (_, one) => {
    const words = [one.question, one.aim, one.paper, ...Object.values(one.choices), ...one.why];
    const runs = one.runs.flatMap((run) =>
      isTraining(run) ? run.words : [...run.words, ...run.tasks.map(({ text }) => text)],
    );
    for (const text of [...words, ...runs]) {
      expect(text).not.toMatch(
        /\d mm (away|of the goal|from the magnet|behind)|(hangs|height of) \d+ cm/,
      );
    }
  },
);

describe('the outcome follows from the measurements', () => {
  it.each<[string, Partial<Track>[], string]>([
    ['magnet', [{ carryingError_m: 0.002 }], 'below'],
    ['magnet', [{ carryingError_m: 0.016 }], 'behind'],
    ['magnet', [{ carryingError_m: 0.09 }], 'edge'],
    ['lose', [{ fetchedAt_s: 5 }], 'fetches'],
    ['threshold', [delivered(10), { losses: 4, ...delivered(14) }], 'later'],
    ['threshold', [delivered(10), { losses: 4, ...delivered(9) }], 'sooner'],
    ['threshold', [delivered(10), delivered(10)], 'nothing'],
    ['chatter', [{ switches: 40 }, {}], 'turns'],
    ['chatter', [{ switches: 2, ...delivered(15) }, {}], 'carries'],
    ['attractor', [{ lingered_s: 30 }, delivered(6)], 'stuck'],
    ['attractor', [delivered(6), delivered(6)], 'around'],
    ['errt', [thereAndBack(14)], 'once'],
    ['errt', [thereAndBack(25)], 'same'],
    ['errt', [thereAndBack(13)], 'never'],
    ['policy', [delivered(16), { lingered_s: 30 }], 'lost'],
    ['policy', [delivered(16), delivered(17)], 'same'],
    ['policy', [delivered(16), delivered(30)], 'longer'],
    ['lift-off', [{ liftedAt_m: 0.0943 }, {}], 'soon'],
    ['lift-off', [{ liftedAt_m: 0.05 }, {}], 'half'],
  ])('%s %j: %s', (id, changes, outcome) => {
    expect(lesson(id).outcome(...changes.map(track))).toBe(outcome);
  });
});

describe('the outcome follows from the examinations', () => {
  it.each<[string, number[], string]>([
    ['learning-fails', [992, 970, 167], 'sparse'],
    ['learning-fails', [100, 970, 900], 'exploration'],
    ['learning-fails', [992, 200, 900], 'discount'],
    ['discount', [600, 380], 'far'],
    ['discount', [380, 600], 'near'],
    ['discount', [600, 590], 'same'],
    ['fine-tuning', [160, 715], 'tuned'],
    ['fine-tuning', [715, 160], 'random'],
    ['fine-tuning', [715, 700], 'same'],
  ])('%s %j: %s', (id, reached, outcome) => {
    const found = LESSONS.find((one) => one.id === id);
    if (!found || !isTrainingLesson(found)) throw new Error(id);
    expect(found.outcome(...reached.map(examined))).toBe(outcome);
  });
});

describe('a button of a lesson', () => {
  it('lowers the magnet, but not below what the server allows', () => {
    const [lower] = lesson('lift-off').runs[0].actions ?? [];
    const scene = sceneOf('open');
    const height = (tool_height_m: number): number => {
      scene.parameters = { ...scene.parameters, tool_height_m };
      const message = lower?.message(scene);
      return message?.type === 'configure' ? message.parameters.tool_height_m : NaN;
    };
    expect(height(0.1)).toBe(0.098);
    expect(height(0.0905)).toBe(0.09);
  });
});

describe('progress', () => {
  it('is read from the storage', () => {
    const stored = { done: ['errt', 'magnet'], choices: { errt: 'once' } };
    expect(progressFrom(JSON.stringify(stored), LESSONS)).toEqual({
      // In the order of the lessons.
      done: ['magnet', 'errt'],
      choices: { errt: 'once' },
    });
  });

  it.each([
    null,
    '',
    '{',
    '7',
    '"done"',
    '[]',
    '{"done":7,"choices":[]}',
    '{"done":{"magnet":true},"choices":"errt"}',
    '{"done":["flying",null,3],"choices":{"errt":"perhaps","flying":"once","magnet":7}}',
    '{"choices":{"__proto__":{"errt":"once"}}}',
  ])('is empty for %s', (text) => {
    expect(progressFrom(text, LESSONS)).toEqual({ done: [], choices: {} });
  });
});
