// The arm's manipulability over the workspace as colours, and the places where it may not go. Pure.

import { fixed } from '../../ui/format';
import type {
  Parameters,
  Rect,
  SceneMessage,
  WorkspaceMap,
  WorkspaceQuery,
} from '../../net/protocol.gen';
import { colourOf, type Ramp, type Range, rangeOf } from '../../plan/colourRamp';
import { gridPixels } from '../../plan/pixels';

/** Fine enough to look smooth on the paper's workspace and on a table of two metres. */
const MIN_CELL_M = 0.005;
const MAX_CELLS_PER_SIDE = 120;

/** Neighbouring cells of a row: `[row, first column, count]`. */
export type Run = readonly [number, number, number];

export function cellM(area: Rect): number {
  const side_m = Math.max(area.x_max_m - area.x_min_m, area.y_max_m - area.y_min_m);
  return Math.max(MIN_CELL_M, side_m / MAX_CELLS_PER_SIDE);
}

/** Undefined without an arm. */
export function workspaceQuery(
  scene: SceneMessage,
  parameters: Parameters,
): WorkspaceQuery | undefined {
  if (scene.positioner !== 'arm') return undefined;
  return {
    area: scene.workspace,
    cell_m: cellM(scene.workspace),
    tool_height_m: parameters.tool_height_m,
    tool_orientation: parameters.tool_orientation,
  };
}

/** Out of reach, or so near a singularity that no controller may go there. */
export function isRefused(map: WorkspaceMap, value_m3: number | null | undefined): boolean {
  return value_m3 === null || value_m3 === undefined || value_m3 < map.least_m3;
}

/** Smallest and greatest value of the cells that are not refused. */
export function heatRange(map: WorkspaceMap): Range | undefined {
  return rangeOf(
    map.manipulability_m3.filter((value_m3): value_m3 is number => !isRefused(map, value_m3)),
  );
}

/**
 * One pixel per cell. Refused cells are hatched. They have the colour of the smallest value, so that smoothing shows no
 * edge there.
 */
export function heatPixels(map: WorkspaceMap, ramp: Ramp): Uint8ClampedArray<ArrayBuffer> {
  const range_m3 = heatRange(map) ?? [0, 0];
  return gridPixels(map.columns, map.rows, (cell) => [
    ...colourOf(ramp, range_m3, map.manipulability_m3[cell] ?? 0),
    255,
  ]);
}

export function refusedRuns(map: WorkspaceMap): Run[] {
  const runs: Run[] = [];
  for (let row = 0; row < map.rows; row++) {
    let first: number | undefined;
    for (let column = 0; column <= map.columns; column++) {
      const refused =
        column < map.columns && isRefused(map, map.manipulability_m3[row * map.columns + column]);
      if (refused) first ??= column;
      else if (first !== undefined) {
        runs.push([row, first, column - first]);
        first = undefined;
      }
    }
  }
  return runs;
}

/** In 10⁻³ m³. */
export const heatWords = (value_m3: number): string => fixed(value_m3 * 1000, 1);

/** Share of the refused cells as text. */
export function refusedWords(map: WorkspaceMap): string {
  const refused = map.manipulability_m3.filter((value) => isRefused(map, value)).length;
  if (refused === 0) return 'none';
  const percent = (100 * refused) / map.manipulability_m3.length;
  return percent < 1 ? 'less than 1 %' : `${fixed(percent, 0)} %`;
}
