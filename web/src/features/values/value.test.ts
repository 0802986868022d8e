import { describe, expect, it } from 'vitest';
import { sceneOf } from '../../lab/testing';
import { valueKey } from './value';

describe('the key', () => {
  it('changes with the goal, map and policy, but not after a reset', () => {
    const scene = sceneOf('colon');
    const key = valueKey(scene, [0.1, 0.2]);
    expect(valueKey({ ...scene, trial: 7, seed: 2 }, [0.1, 0.2])).toBe(key);
    const shieldless = { ...scene.parameters, rl_shield: false };
    expect(valueKey({ ...scene, parameters: shieldless }, [0.1, 0.2])).toBe(key);
    expect(valueKey(scene, [0.1, 0.3])).not.toBe(key);
    expect(valueKey(sceneOf('posts'), [0.1, 0.2])).not.toBe(key);
    const general = { ...scene.parameters, rl_policy: 'general' as const };
    expect(valueKey({ ...scene, parameters: general }, [0.1, 0.2])).not.toBe(key);
  });
});
