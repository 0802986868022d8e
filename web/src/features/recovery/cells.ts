// What the cells of a recovery map say. Pure.

import type { Vec2 } from '../../lab/geometry';
import { labelOf } from '../../lab/parameters';
import type {
  RecoveryCell,
  RecoveryKind,
  RecoveryReport,
  RecoveryTrial,
} from '../../net/protocol.gen';
import { fixed } from '../../ui/format';

/** How a cell is drawn. */
export interface Look {
  readonly kind: 'delivered' | 'late' | 'lost' | 'first' | 'second' | 'equal';
  /** 0 to 1; the stronger, the more opaque. */
  readonly strength: number;
}

/** The disturbance, as it is chosen. */
export const KIND_WORDS: Readonly<Record<RecoveryKind, string>> = {
  place: 'Put elsewhere',
  push: 'Push',
  drag: 'Pull by hand',
  blind: 'Blind tracker',
};

const CM2_PER_M2 = 1e4;
const MM_PER_M = 1000;
const MN_PER_N = 1000;
const CM_PER_M = 100;

/** What happened most often in a cell; of two, the better one. */
export function look({ delivered, late, lost, repeats }: RecoveryCell): Look {
  const most = Math.max(delivered, late, lost);
  if (most === delivered) return { kind: 'delivered', strength: delivered / repeats };
  return { kind: most === late ? 'late' : 'lost', strength: 1 };
}

/** The share that one controller delivers, minus that of another. */
export function difference(first: RecoveryCell, second: RecoveryCell): Look {
  const points = first.delivered / first.repeats - second.delivered / second.repeats;
  if (points === 0) return { kind: 'equal', strength: 1 };
  return { kind: points > 0 ? 'first' : 'second', strength: Math.abs(points) };
}

/** The controller whose cells are shown, or the two whose difference is. */
export const titleOf = ({ names }: RecoveryReport, indices: readonly number[]): string =>
  indices.map((index) => labelOf(names[index] ?? '')).join(' minus ');

export const rowsOf = (
  { cells }: Pick<RecoveryReport, 'cells'>,
  name: string,
): readonly RecoveryCell[] => cells.filter(({ controller }) => controller === name);

/** How each cell looks, by its number; `pair` has the index of one controller or of two. */
export function looksOf(
  report: RecoveryReport,
  pair: readonly number[],
): ReadonlyMap<number, Look> {
  const [first = [], second] = pair.map((index) => rowsOf(report, report.names[index] ?? ''));
  if (!second) return new Map(first.map((row) => [row.cell, look(row)]));
  const others = new Map(second.map((row) => [row.cell, row]));
  return new Map(
    first.flatMap((row) => {
      const other = others.get(row.cell);
      return other ? [[row.cell, difference(row, other)] as const] : [];
    }),
  );
}

/** `2 delivered, 1 not delivered (lifted off); median 12.3 s`. */
export function cellWords(row: RecoveryCell): string {
  const parts = [`${row.delivered} delivered`];
  if (row.late > 0) parts.push(`${row.late} late`);
  if (row.lost > 0)
    parts.push(`${row.lost} not delivered${row.why === null ? '' : ` (${row.why})`}`);
  const median = row.time_s_median === null ? '' : `; median ${fixed(row.time_s_median, 1)} s`;
  return `${parts.join(', ')}${median}`;
}

/** What was done to the bead or to the tracker. */
export function spotWords(row: RecoveryCell, kind: RecoveryReport['kind']): string {
  if (kind === 'place') {
    return `bead put to x ${fixed(row.x_m ?? 0, 3)} m, y ${fixed(row.y_m ?? 0, 3)} m`;
  }
  const strength = row.strength ?? 0;
  if (kind === 'blind') {
    return `tracker blind for ${fixed(strength, 1)} s, ${fixed(row.at_s ?? 0, 1)} s after the moment`;
  }
  const degrees = Math.round(((row.direction_rad ?? 0) * 180) / Math.PI);
  return kind === 'push'
    ? `pushed toward ${degrees}° with ${fixed(strength * MN_PER_N, 1)} mN`
    : `pulled toward ${degrees}° over ${fixed(strength * CM_PER_M, 0)} cm`;
}

export const squareCentimetres = (area_m2: number): string =>
  `${fixed(area_m2 * CM2_PER_M2, 0)} cm²`;

/** `trial 2: not delivered (stopped: 150 steps …), 42.0 s`. */
export function trialWords(trial: RecoveryTrial): string {
  const end = trial.outcome === 'lost' ? `not delivered (${trial.phase})` : trial.outcome;
  return `trial ${trial.repeat + 1}: ${end}, ${fixed(trial.time_s, 1)} s`;
}

/** The cell of a place, if the map has one there. */
export function cellAt(
  report: RecoveryReport,
  [x_m, y_m]: readonly [number, number],
): number | undefined {
  const has = (row: RecoveryCell): boolean => {
    if (row.x_m === null || row.y_m === null || row.size_m === null) return false;
    const half_m = row.size_m / 2;
    return Math.abs(x_m - row.x_m) <= half_m && Math.abs(y_m - row.y_m) <= half_m;
  };
  return report.cells.find(has)?.cell;
}

/** Whether a recovery map was made for the present goal. */
export const isForGoal = (
  { goal_m }: Pick<RecoveryReport, 'goal_m'>,
  goal: Vec2 | undefined,
): boolean => goal_m?.[0] === goal?.[0] && goal_m?.[1] === goal?.[1];

/** A length for a drawing, in thousandths of a metre. */
export const mm = (length_m: number): number => length_m * MM_PER_M;
