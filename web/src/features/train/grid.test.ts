import { describe, expect, it } from 'vitest';
import { around, cellAt, fanAt, startsThat, valueCells } from './grid';
import { CELLS, frameOf } from './testing';

describe('the cells', () => {
  it('are found by place', () => {
    expect(cellAt(CELLS, [0.021, 0.002])).toBe(1);
    expect(cellAt(CELLS, [0.1, 0.1])).toBeUndefined();
  });

  it('have a rectangle around them', () => {
    const { x_min_m, x_max_m, y_min_m, y_max_m } = around(CELLS);
    expect(x_min_m).toBeCloseTo(0.005);
    expect(x_max_m).toBeCloseTo(0.035);
    expect(y_min_m).toBeCloseTo(-0.005);
    expect(y_max_m).toBeCloseTo(0.015);
  });

  it('have the values of a frame', () => {
    expect(valueCells(CELLS, frameOf(100)).cells[1]).toEqual({
      center_m: [0.02, 0],
      value: 0.8,
      action: 0,
    });
    expect(startsThat(frameOf(100), 'reached')).toEqual([0, 3]);
  });
});

it('has the quantiles of a cell in order, over the updates', () => {
  const fan = fanAt([frameOf(100), frameOf(200)], 0);
  expect(fan.updates).toEqual([100, 200]);
  expect(fan.quantiles.map(([first]) => first)).toEqual([0.1, 0.2, 0.3, 0.4, 0.5]);
});
