import { describe, expect, it } from 'vitest';
import {
  FIELDS as fields,
  PRESET_KINDS,
  digits,
  type NumberField,
  type PolicyField,
  policyOptions,
  presetOf,
  shownMost,
  shownValue,
  storedValue,
  withFollowers,
} from './parameters';
import { sceneOf } from './testing';

const { defaults } = sceneOf('posts');
const numbers = fields.filter((field): field is NumberField => field.kind === 'number');

function field(name: string): NumberField {
  const found = numbers.find((one) => one.name === name);
  if (!found) throw new Error(name);
  return found;
}

describe('the form', () => {
  it('has every parameter exactly once', () => {
    expect(fields.map(({ name }) => name).sort()).toEqual(Object.keys(defaults).sort());
  });

  it('has all defaults in range and shows them without rounding', () => {
    for (const one of numbers) {
      const shown = shownValue(one, defaults[one.name]);
      expect(shown).toBeGreaterThanOrEqual(one.min);
      expect(shown).toBeLessThanOrEqual(one.max);
      expect(Number(shown.toFixed(digits(one.step)))).toBe(shown);
    }
  });

  it('stores exactly what it shows', () => {
    for (const one of numbers) {
      const stored = defaults[one.name];
      expect(storedValue(one, shownValue(one, stored), defaults)).toBe(stored);
    }
  });

  it('rounds integer parameters', () => {
    expect(storedValue(field('errt_ways'), 2.6, defaults)).toBe(3);
    expect(storedValue(field('friction'), 0.257, defaults)).toBe(0.257);
  });

  it('stays in the range and keeps the fetch radius below T', () => {
    expect(storedValue(field('tool_height_m'), 5, defaults)).toBe(0.09);
    expect(storedValue(field('fetch_radius_m'), 15, defaults)).toBe(defaults.threshold_m);
  });

  it('keeps the sum of waypoint probability and goal probability at most 1', () => {
    const parameters = { ...defaults, errt_goal_probability: 0.7 };
    const waypoints = field('errt_waypoint_probability');
    expect(shownMost(waypoints, defaults)).toBe(90);
    expect(shownMost(waypoints, parameters)).toBe(30);
    const stored = storedValue(waypoints, 80, parameters);
    expect(stored + parameters.errt_goal_probability).toBeLessThanOrEqual(1);
  });

  it('also changes parameters that a change pushes out of range', () => {
    const follow = (change: Partial<typeof defaults>): Partial<typeof defaults> =>
      withFollowers(defaults, change);
    expect(follow({ threshold_m: 0.005 })).toEqual({ threshold_m: 0.005, fetch_radius_m: 0.005 });
    expect(follow({ errt_goal_probability: 0.75 }).errt_waypoint_probability).toBe(0.25);
    expect(follow({ errt_goal_probability: 0.3 })).toEqual({ errt_goal_probability: 0.3 });
  });
});

it('names the preset whose values the parameters have', () => {
  const { defaults } = sceneOf('posts');
  const [sensors, mounts] = PRESET_KINDS;
  if (!sensors || !mounts) throw new Error('there are two kinds');
  const names = (parameters: typeof defaults): (string | undefined)[] =>
    [sensors, mounts].map((kind) => kind.presets[presetOf(kind, parameters)]?.label);
  expect(names(defaults)).toEqual(['Laboratory', 'Ideal']);
  const poor = { ...defaults, friction: 0.3, ...sensors.presets[1]?.values };
  expect(names(poor)).toEqual(['Poor sensors', 'Ideal']);
  expect(names({ ...poor, ...mounts.presets[1]?.values })).toEqual(['Poor sensors', 'Realistic']);
  expect(names({ ...poor, tracker_dropout: 0.05 })).toEqual([undefined, 'Ideal']);
});

describe('the choice of a policy', () => {
  const policy = fields.find((one): one is PolicyField => one.kind === 'policy');
  if (!policy) throw new Error('there is no policy');
  const added = ['mine@00ff00ff00ff00ff'];

  it('has the shipped policies and the added ones by name', () => {
    const options = policyOptions(policy, added, 'auto');
    expect(options.slice(0, -1)).toEqual(policy.options);
    expect(options.at(-1)).toEqual([added[0], 'mine']);
  });

  it('shows a policy that the server does not have any more', () => {
    const options = policyOptions(policy, [], 'mine@00ff00ff00ff00ff');
    expect(options.at(-1)).toEqual(['mine@00ff00ff00ff00ff', 'mine (not on this server)']);
  });
});
