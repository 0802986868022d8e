import { describe, expect, it } from 'vitest';
import type { ValueMap } from '../../net/protocol.gen';
import { sceneOf } from '../../lab/testing';
import { valueArrows, valueKey, valuePicture, valueRange } from './value';
import type { Ramp } from '../../plan/colourRamp';

const RAMP: Ramp = ['#000000', '#646464', '#ff0080'];

/** Two cells side by side, and one above the right cell. */
const MAP: ValueMap = {
  spacing_m: 0.01,
  cells: [
    { center_m: [0.105, -0.395], value: 0.2, action: 0 },
    { center_m: [0.115, -0.395], value: 0.6, action: 2 },
    { center_m: [0.115, -0.385], value: 1, action: 3 },
  ],
  trained_on: ['colon'],
  has_memory: false,
};
const NONE: ValueMap = { ...MAP, cells: [] };

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

describe('the legend', () => {
  it('has the lowest and the highest value', () => {
    expect(valueRange(MAP)).toEqual([0.2, 1]);
    expect(valueRange(NONE)).toBeUndefined();
  });
});

describe('the picture', () => {
  it('is upright and transparent outside the cells', () => {
    const picture = valuePicture(MAP, RAMP);
    expect([picture?.columns, picture?.rows]).toEqual([2, 2]);
    expect(picture?.corner_m[0]).toBeCloseTo(0.1);
    expect(picture?.corner_m[1]).toBeCloseTo(-0.38);
    const pixel = (index: number) => [
      ...(picture?.pixels.subarray(4 * index, 4 * index + 4) ?? []),
    ];
    expect(pixel(0)).toEqual([0, 0, 0, 0]);
    expect(pixel(1)).toEqual([255, 0, 128, 255]);
    expect(pixel(2)).toEqual([0, 0, 0, 255]);
    expect(pixel(3)).toEqual([100, 100, 100, 255]);
  });

  it('is undefined without cells', () => {
    expect(valuePicture(NONE, RAMP)).toBeUndefined();
  });
});

describe('the arrows', () => {
  it('point along the best step and stay in their cells', () => {
    const arrows = valueArrows(MAP, 2000);
    const steps = arrows.map(({ from_m, to_m }) => [
      Math.round((to_m[0] - from_m[0]) * 1e4) / 1e4,
      Math.round((to_m[1] - from_m[1]) * 1e4) / 1e4,
    ]);
    expect(steps).toEqual([
      [0.006, 0],
      [0, 0.006],
      [0, -0.006],
    ]);
  });

  it('are fewer and longer for small cells', () => {
    const arrows = valueArrows(MAP, 1000);
    expect(arrows).toHaveLength(0);
    const shifted = {
      ...MAP,
      cells: [
        ...MAP.cells,
        { center_m: [0.105, -0.385] as [number, number], value: 0.5, action: 0 },
      ],
    };
    const [arrow, ...more] = valueArrows(shifted, 1000);
    expect(more).toHaveLength(0);
    expect((arrow?.to_m[0] ?? 0) - (arrow?.from_m[0] ?? 0)).toBeCloseTo(0.012);
  });

  it('are missing for an unknown action', () => {
    const strange = {
      ...MAP,
      cells: [{ center_m: [0, 0] as [number, number], value: 1, action: 4 }],
    };
    expect(valueArrows(strange, 2000)).toEqual([]);
  });
});
