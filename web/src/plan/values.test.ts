import { describe, expect, it } from 'vitest';
import type { Ramp } from './colourRamp';
import { type ValueCells, valueArrows, valuePicture, valueRange } from './values';

const RAMP: Ramp = ['#000000', '#646464', '#ff0080'];

/** Two cells side by side, and one above the right cell. */
const MAP: ValueCells = {
  spacing_m: 0.01,
  cells: [
    { center_m: [0.105, -0.395], value: 0.2, action: 0 },
    { center_m: [0.115, -0.395], value: 0.6, action: 2 },
    { center_m: [0.115, -0.385], value: 1, action: 3 },
  ],
};
const NONE: ValueCells = { ...MAP, cells: [] };

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

  it('has the colours of a given range', () => {
    const pixels = valuePicture(MAP, RAMP, [1, 2])?.pixels.subarray(4, 8);
    expect([...(pixels ?? [])]).toEqual([0, 0, 0, 255]);
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
