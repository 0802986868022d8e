// How each cell of a figure looks: the outcome of one controller, or the difference of two. Pure.

import type { RecoveryReport } from '../../net/protocol.gen';
import { difference, look, type Look, rowsOf } from './cells';

/** By the number of the cell; `pair` has the index of one controller or of two. */
export function looksOf(
  report: RecoveryReport,
  pair: readonly number[],
): ReadonlyMap<number, Look> {
  const [first, second] = pair.map((index) => rowsOf(report, report.names[index] ?? ''));
  const looks = new Map<number, Look>();
  if (!second) {
    for (const row of first ?? []) looks.set(row.cell, look(row));
    return looks;
  }
  const others = new Map(second.map((row) => [row.cell, row]));
  for (const row of first ?? []) {
    const other = others.get(row.cell);
    if (other) looks.set(row.cell, difference(row, other));
  }
  return looks;
}
