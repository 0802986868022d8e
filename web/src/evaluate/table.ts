// Rows as text: in the table, and in the files to download. Pure.

import { fixed } from '../format';
import type { EvaluationFailure, EvaluationReport, Row } from '../protocol.gen';

export function percentRange([low, high]: readonly [number, number]): string {
  return `${fixed(100 * low, 0)}–${fixed(100 * high, 0)} %`;
}

/** Centimetres without their unit, which stands in the column's head. */
export function cm(value_m: number | undefined): string {
  return value_m === undefined ? '–' : fixed(100 * value_m, 1);
}

export function decisionWords(row: Row): string {
  return `${fixed(row.decision_ms_p50, 1)} · ${fixed(row.decision_ms_p99, 1)}`;
}

/** Why a trial failed: how it ended, and what stood in the way. */
export function reason({ outcome, trouble, refusal }: EvaluationFailure): string {
  return [outcome, trouble, refusal].filter((why) => why !== null).join('; ');
}

const COLUMNS = [
  'controller',
  'map',
  'disturbances',
  'episodes',
  'successes',
  'successes_wilson95',
  'delivered',
  'wilson95',
  'tracking_error_mean_m',
  'tracking_error_max_x_m',
  'tracking_error_max_y_m',
  'steps_mean',
  'switches_mean',
  'disturbances_struck',
  'decision_ms_p50',
  'decision_ms_p99',
] as const satisfies readonly (keyof Row)[];

/** An interval takes two columns. */
function heads(column: (typeof COLUMNS)[number]): string[] {
  return column.endsWith('wilson95') ? [`${column}_low`, `${column}_high`] : [column];
}

function fields(row: Row, column: (typeof COLUMNS)[number]): (string | number)[] {
  const value = row[column];
  return Array.isArray(value) ? value : [value];
}

/** RFC 4180, numbers in full; nothing in a row needs quotes but for a map's name, which may be anything. */
export function csv(rows: readonly Row[], seed: number): string {
  const quoted = (value: string | number): string =>
    typeof value === 'string' && /[",\r\n]/.test(value)
      ? `"${value.replaceAll('"', '""')}"`
      : String(value);
  const lines = [
    [...COLUMNS.flatMap(heads), 'seed'],
    ...rows.map((row) => [...COLUMNS.flatMap((column) => fields(row, column)), seed]),
  ];
  return lines.map((line) => `${line.map(quoted).join(',')}\r\n`).join('');
}

/** The server's answer as it is. */
export function json(report: EvaluationReport): string {
  return `${JSON.stringify(report, undefined, 2)}\n`;
}

export function fileName({ id, query }: EvaluationReport, ending: string): string {
  return `ferry-${id}-seed-${query.seed}.${ending}`;
}
