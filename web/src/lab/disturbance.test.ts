import { describe, expect, it } from 'vitest';
import {
  blind,
  describe as words,
  describeWhen,
  kick,
  move,
  push,
  restart,
  unitVector,
} from './disturbance';
import type { Scripted } from '../net/protocol.gen';
import { sceneOf, stateAt } from './testing';

describe('a direction', () => {
  it('is as on the screen: x to the right, y up', () => {
    expect(unitVector('left', 0.3)).toEqual([-1, 0]);
    expect(unitVector('up', 0.3)).toEqual([0, 1]);
  });

  it('can be any direction if it is random', () => {
    expect(unitVector('random', 0.25)[1]).toBeCloseTo(1);
    for (const chance of [0, 0.1, 0.37, 0.99]) {
      expect(Math.hypot(...unitVector('random', chance))).toBeCloseTo(1);
    }
  });
});

describe('a disturbance', () => {
  it('is sent in newtons and seconds', () => {
    expect(kick(2, [1, 0])).toEqual({ impulse: { x_n_s: 0.002, y_n_s: 0 } });
    expect(push(3, 1.5, [0, -1])).toEqual({ drift: { x_n: 0, y_n: -0.003, for_s: 1.5 } });
    expect(blind(2)).toEqual({ dropout: { for_s: 2 } });
  });
});

describe('as text', () => {
  it('a disturbance has a strength and a direction', () => {
    expect(words(kick(1.5, [0, 1]))).toBe('kick ↑ 1.50 mN·s');
    expect(words(push(2, 3, [-1, 0]))).toBe('push ← 2.0 mN for 3 s');
    expect(words(move(0.1, -0.35))).toBe('move to (0.100, −0.350) m');
    expect(words(blind(4))).toBe('tracker blind for 4 s');
  });

  it('a time is shown with its condition', () => {
    expect(describeWhen({ tick: 250 }, 0.008)).toBe('at 2.0 s');
    expect(describeWhen({ step: 29 }, 0.008)).toBe('at step 29');
    expect(describeWhen({ passes_x_m: -0.21 }, 0.008)).toBe('passing x = −0.210 m');
    expect(describeWhen({ near: { x_m: 0, y_m: -0.3, within_m: 0.02 } }, 0.008)).toBe(
      'within 2.0 cm of (0.000, −0.300) m',
    );
  });
});

describe('a restart', () => {
  const entry: Scripted = { at: { tick: 100 }, disturbance: blind(1) };

  it('changes the disturbances and nothing else', () => {
    const scene = sceneOf('colon');
    const scenario = {
      ...scene.scenario,
      start_m: [0.1, -0.3] as [number, number],
      goal_m: [0.2, -0.4] as [number, number],
      disturbances: 2,
    };
    const state = stateAt(700, { controller: 'errt' });
    expect(restart({ ...scene, scenario }, state, { script: [entry] })).toEqual({
      type: 'load_scenario',
      map: 'colon',
      controller: 'errt',
      seed: 1,
      start_m: [0.1, -0.3],
      goal_m: [0.2, -0.4],
      parameters: scene.parameters,
      disturbances: 2,
      script: [entry],
    });
  });

  it('keeps the script and a new goal; a random start still follows from the seed', () => {
    const scene = sceneOf('colon');
    const scenario = { ...scene.scenario, script: [entry] };
    const state = stateAt(700, { goal_m: [0.0500123, -0.25, 0] });
    const message = restart({ ...scene, scenario }, state, { disturbances: 3 });
    expect(message).toMatchObject({ goal_m: [0.0500123, -0.25], disturbances: 3, script: [entry] });
    expect(message).not.toHaveProperty('start_m');
  });
});
