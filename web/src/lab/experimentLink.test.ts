import { describe, expect, it } from 'vitest';
import {
  type Experiment,
  experimentFrom,
  experimentOf,
  type Known,
  linkOf,
  linkText,
  loadMessage,
} from './experimentLink';
import { FIELDS } from './parameters';
import type { Disturbance, Parameters, Scripted, When } from '../net/protocol.gen';
import { sceneOf, stateAt } from './testing';

const { defaults } = sceneOf('colon');
const KNOWN: Known = {
  maps: [
    'attractor-example',
    'attractor-example-arm',
    'colon',
    'colon-folds',
    'open',
    'posts',
    'vessels',
    // No built-in map has such a name, but a user's map might.
    'Übung & Prüfung #1 = 100 %',
  ],
  controllers: ['rl', 'errt', 'attractor'],
  defaults,
};

/** Reproducible numbers in [0, 1) (mulberry32). */
function chances(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** A random experiment with everything that a link can contain. */
function anyExperiment(chance: () => number): Experiment {
  const pick = <T>(all: readonly T[]): T => {
    const one = all[Math.floor(chance() * all.length)];
    if (one === undefined) throw new Error('nothing to pick from');
    return one;
  };
  const some = (): number => (chance() - 0.5) * 10 ** Math.floor(chance() * 12 - 9);
  const place = (): [number, number] => [some(), some()];
  const disturbance = (): Disturbance =>
    pick<() => Disturbance>([
      () => ({ displace: { x_m: some(), y_m: some() } }),
      () => ({ impulse: { x_n_s: some(), y_n_s: some() } }),
      () => ({ drift: { x_n: some(), y_n: some(), for_s: some() } }),
      () => ({ dropout: { for_s: some() } }),
    ])();
  const when = (): When =>
    pick<() => When>([
      () => ({ tick: Math.floor(chance() * 1e6) }),
      () => ({ step: Math.floor(chance() * 600) }),
      () => ({ passes_x_m: some() }),
      () => ({ near: { x_m: some(), y_m: some(), within_m: some() } }),
    ])();
  const parameters: Partial<Record<keyof Parameters, unknown>> = {};
  for (const field of FIELDS) {
    if (chance() < 0.7) continue;
    const value =
      field.kind === 'number'
        ? some()
        : field.kind === 'flag'
          ? chance() < 0.5
          : pick(field.options)[0];
    if (value !== defaults[field.name]) parameters[field.name] = value;
  }
  const script = Array.from({ length: Math.floor(chance() * 4) }, (): Scripted => ({
    at: when(),
    disturbance: disturbance(),
  }));
  return {
    map: pick(KNOWN.maps),
    controller: pick(KNOWN.controllers),
    positioner: pick([null, 'arm', 'planar_stage'] as const),
    seed: Math.floor(chance() * 2 ** 32),
    start_m: chance() < 0.5 ? place() : null,
    goal_m: chance() < 0.5 ? place() : null,
    parameters: parameters as Partial<Parameters>,
    disturbances: Math.floor(chance() * 3),
    script,
    drawing: pick([null, 'q1YqVrI_-0']),
  };
}

function why(hash: string): string {
  const reading = experimentFrom(hash, KNOWN);
  if (reading.kind !== 'broken') throw new Error(`${hash} was read as ${reading.kind}`);
  return reading.why;
}

describe('a link', () => {
  it('returns the same experiment and the same text', () => {
    const chance = chances(7);
    for (let round = 0; round < 500; round += 1) {
      const experiment = anyExperiment(chance);
      const text = linkText(experiment, defaults);
      expect(experimentFrom(text, KNOWN)).toEqual({ kind: 'experiment', experiment });
      // A browser may encode other characters after #, but never these.
      expect(text).toMatch(/^#[\w=&.,:;@%-]+$/);
    }
  });

  it('reads the link that the server writes with a failure', () => {
    // `server/core/scenario/link.rs` has the same line.
    const text =
      '#v=1&map=colon&controller=errt&seed=9007199254740991&start=-0.1234567890123,-0.3' +
      '&goal=0.1,0.0000001&attractor_law=literal&threshold_m=0.08&disturbances=3';
    const read = experimentFrom(text, KNOWN);
    expect(read).toMatchObject({
      kind: 'experiment',
      experiment: {
        seed: Number.MAX_SAFE_INTEGER,
        start_m: [-0.1234567890123, -0.3],
        goal_m: [0.1, 1e-7],
        parameters: { attractor_law: 'literal', threshold_m: 0.08 },
        disturbances: 3,
      },
    });
  });

  it('is readable, and contains only parameters that are not at their default', () => {
    const scene = sceneOf('colon');
    scene.seed = 7;
    scene.parameters = { ...scene.parameters, threshold_m: 0.08 };
    const state = stateAt(10, { controller: 'errt', goal_m: [-0.24, -0.27, 0] });
    expect(linkOf(scene, state)).toBe(
      '#v=1&map=colon&controller=errt&seed=7&goal=-0.24,-0.27&threshold_m=0.08',
    );
  });

  it('contains the current goal, controller and parameters, and the original start', () => {
    const scene = sceneOf('posts');
    scene.scenario.start_m = [0.1, -0.3];
    scene.scenario.disturbances = 2;
    scene.scenario.script = [{ at: { step: 3 }, disturbance: { dropout: { for_s: 2 } } }];
    scene.scenario.positioner = 'planar_stage';
    // A goal from the mouse is rounded.
    const goal_m: [number, number, number] = [0.123456789, -0.3000001, 0];
    expect(experimentOf(scene, stateAt(5, { goal_m, controller: 'rl' }))).toEqual({
      map: 'posts',
      controller: 'rl',
      positioner: 'planar_stage',
      seed: 1,
      start_m: [0.1, -0.3],
      goal_m: [0.1235, -0.3],
      parameters: {},
      disturbances: 2,
      script: scene.scenario.script,
      drawing: null,
    });
    // A goal from the scenario is not rounded.
    scene.scenario.goal_m = [0.123456789, -0.3000001];
    expect(experimentOf(scene, stateAt(5, { goal_m })).goal_m).toEqual([0.123456789, -0.3000001]);
  });

  it('becomes the command that loads it', () => {
    const read = experimentFrom('#v=1&map=open&controller=rl&seed=3&friction=0.5', KNOWN);
    if (read.kind !== 'experiment') throw new Error('not read');
    expect(loadMessage(read.experiment, defaults)).toEqual({
      type: 'load_scenario',
      map: 'open',
      controller: 'rl',
      seed: 3,
      disturbances: 0,
      script: [],
      parameters: { ...defaults, friction: 0.5 },
    });
  });

  it('may be percent-encoded', () => {
    const read = experimentFrom('#v=1&map=colon&controller=errt&seed=7&goal=-0.24%2C-0.27', KNOWN);
    expect(read).toMatchObject({ experiment: { goal_m: [-0.24, -0.27] } });
  });
});

describe('an invalid link', () => {
  const GOOD = '#v=1&map=colon&controller=errt&seed=7';

  it('is not reported if the hash is empty', () => {
    expect(experimentFrom('', KNOWN)).toEqual({ kind: 'none' });
    expect(experimentFrom('#', KNOWN)).toEqual({ kind: 'none' });
  });

  it.each([
    ['#top', '“#top” does not start with #v=1'],
    ['#v=2&map=colon', 'v is “2”; this page reads version 1'],
    ['#v=1&controller=errt&seed=7', 'map is missing'],
    ['#v=1&map=colon&controller=errt&seed=7&drawing=a%2Bb', 'drawing is “a+b”; it must be'],
    [
      '#v=1&map=liver&controller=errt&seed=7',
      'map is “liver”; it must be one of attractor-example',
    ],
    ['#v=1&map=colon&controller=magic&seed=7', 'controller is “magic”; it must be one of rl, errt'],
    [
      '#v=1&map=colon&controller=errt&seed=-7',
      'seed is “-7”; it must be a whole number, 0 or larger',
    ],
    ['#v=1&map=colon&controller=errt&seed=1e99', 'seed is “1e99”'],
    [`${GOOD}&seed=8`, 'seed appears twice'],
    [`${GOOD}&goal=0.1`, 'goal is “0.1”; it must be 2 numbers'],
    [`${GOOD}&goal=0.1,here`, 'goal is “here”; it must be a number'],
    [`${GOOD}&positioner=crane`, 'positioner is “crane”; it must be one of arm, planar_stage'],
    [`${GOOD}&friction=much`, 'friction is “much”; it must be a number'],
    [`${GOOD}&friction=`, 'friction is “”; it must be a number'],
    [`${GOOD}&friction=Infinity`, 'friction is “Infinity”'],
    [`${GOOD}&friction`, '“friction” has no value'],
    [`${GOOD}&rl_shield=1`, 'rl_shield is “1”; it must be one of true, false'],
    [`${GOOD}&switching_law=strict`, 'switching_law is “strict”; it must be one of hysteresis'],
    [`${GOOD}&gravity=9.81`, '“gravity” is not a known name (its value is “9.81”)'],
    [`${GOOD}&toString=1`, '“toString” is not a known name'],
    [`${GOOD}&script=`, 'script is “”; it must be a disturbance, @, and when'],
    [`${GOOD}&script=hit:1,2@tick:3`, 'script is “hit:1,2”; it must be displace, impulse'],
    [`${GOOD}&script=dropout:1@noon:12`, 'script is “noon:12”; it must be tick, step'],
    [`${GOOD}&script=dropout:1@tick:1.5`, 'script is “1.5”; it must be a whole number'],
    [`${GOOD}&goal=%E0%A4%A`, '“goal=%E0%A4%A” is damaged'],
  ])('%s is refused with field and value', (hash, words) => {
    expect(why(hash)).toContain(words);
  });
});
