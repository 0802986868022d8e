import { describe, expect, it } from 'vitest';
import type { WorkspaceMap } from '../../net/protocol.gen';
import { sceneOf } from '../../lab/testing';
import { cellM, heatPixels, heatRange, refusedRuns, refusedWords, workspaceQuery } from './heat';
import { type Ramp, rampColour } from '../../plan/colourRamp';

const RAMP: Ramp = ['#000000', '#646464', '#ff0080'];

/** The upper row is partly out of reach, the lower row is partly singular. */
const MAP: WorkspaceMap = {
  least_m3: 0.002,
  columns: 3,
  rows: 2,
  origin_m: [0, 0],
  cell_m: 0.1,
  manipulability_m3: [0.001, 0.01, 0.03, null, null, 0.02],
};

describe('the request', () => {
  const scene = sceneOf('posts');

  it('depends on map, height and orientation', () => {
    const query = workspaceQuery(scene, { ...scene.parameters, tool_height_m: 0.15 });
    expect(query).toEqual({
      area: scene.workspace,
      cell_m: 0.005,
      tool_height_m: 0.15,
      tool_orientation: 'vertical',
    });
  });

  it('is not sent without an arm', () => {
    const planar = { ...scene, positioner: 'planar_stage' as const };
    expect(workspaceQuery(planar, scene.parameters)).toBeUndefined();
  });

  it('has coarser cells on a larger table', () => {
    const table = { x_min_m: -1, x_max_m: 1, y_min_m: 0, y_max_m: 1 };
    expect(2 / cellM(table)).toBeLessThanOrEqual(120);
  });
});

describe('the legend', () => {
  it('has the smallest and the greatest allowed value', () => {
    expect(heatRange(MAP)).toEqual([0.01, 0.03]);
    expect(heatRange({ ...MAP, manipulability_m3: [null, 0.001] })).toBeUndefined();
  });

  it('shows the refused share', () => {
    expect(refusedWords(MAP)).toBe('50 %');
    expect(refusedWords({ ...MAP, manipulability_m3: [0.01] })).toBe('none');
    const almostNone = [null, ...new Array<number>(400).fill(0.01)];
    expect(refusedWords({ ...MAP, manipulability_m3: almostNone })).toBe('less than 1 %');
  });
});

describe('the colours', () => {
  it('go from the smallest through the middle to the greatest value', () => {
    expect(rampColour(RAMP, 0)).toEqual([0, 0, 0]);
    expect(rampColour(RAMP, 0.25)).toEqual([50, 50, 50]);
    expect(rampColour(RAMP, 0.5)).toEqual([100, 100, 100]);
    expect(rampColour(RAMP, 1)).toEqual([255, 0, 128]);
    expect(rampColour(RAMP, 7)).toEqual([255, 0, 128]);
  });

  it('are upright: the upper row of the table is the first row of the picture', () => {
    const pixels = heatPixels(MAP, RAMP);
    const at = (cell: number): number[] => [...pixels.subarray(4 * cell, 4 * cell + 4)];
    expect(at(2)).toEqual([100, 100, 100, 255]);
    expect(at(5)).toEqual([255, 0, 128, 255]);
    expect(at(3)).toEqual([0, 0, 0, 255]);
  });
});

describe('the hatching', () => {
  it('covers cells that are singular or out of reach, in runs', () => {
    expect(refusedRuns(MAP)).toEqual([
      [0, 0, 1],
      [1, 0, 2],
    ]);
  });
});
