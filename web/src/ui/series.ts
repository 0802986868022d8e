// Values with their intervals along a common axis, as columns of a plot. Pure.

import { fixed } from './format';

/** Null where a point has no value. */
export type Interval = readonly [high: number | null, low: number | null, value: number | null];
export type Points = readonly (readonly [x: number, Interval])[];
type Column = (number | null)[];

/** What the values are, and how they are shown. */
export interface Measure {
  readonly title: string;
  readonly unit: string;
  readonly digits: number;
  readonly suffix?: string;
  readonly axisDigits: number;
  /** Ends of the axis. */
  readonly range: (max: number, min: number) => readonly [number, number];
  /** A band joins the intervals of all points; bars are for few points, and the words have them, too. */
  readonly intervals: 'band' | 'bars' | 'both';
}

/** The places of all lines together, and for each line its upper ends, lower ends and values. */
export function columnsOf(lines: readonly Points[]): [number[], ...Column[]] {
  const places = [...new Set(lines.flatMap((points) => points.map(([x]) => x)))];
  places.sort((a, b) => a - b);
  const columns = lines.flatMap((points) => {
    const byPlace = new Map(points);
    return ([0, 1, 2] as const).map((part) => places.map((x) => byPlace.get(x)?.[part] ?? null));
  });
  return [places, ...columns];
}

/** The values at one place, for each line that has one; undefined without. */
export function readWords(
  { digits, suffix = '', intervals }: Pick<Measure, 'digits' | 'suffix' | 'intervals'>,
  labels: readonly string[],
  columns: readonly (readonly (number | null)[])[],
  index: number,
): string | undefined {
  const text = (value: number): string => fixed(value, digits);
  const parts = labels.flatMap((label, line) => {
    const [high, low, value] = [1, 2, 3].map((part) => columns[3 * line + part]?.[index]);
    if (typeof value !== 'number') return [];
    const interval =
      intervals !== 'band' && typeof low === 'number' && typeof high === 'number'
        ? ` (${text(low)} to ${text(high)})`
        : '';
    return [`${label} ${text(value)}${interval}${suffix}`];
  });
  return parts.length === 0 ? undefined : parts.join(', ');
}
