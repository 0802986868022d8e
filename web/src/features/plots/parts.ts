// The parts of the paper's figure: five over time, and the locus in the plane.

import type { Column } from '../../lab/history';
import type { Rule } from '../../ui/curve';
import { fixed } from '../../ui/format';
import type { Sample } from './sample';
import type { Palette } from '../../ui/palette';

export interface Line {
  readonly column: Column;
  readonly label: string;
  readonly color: keyof Palette;
}

export interface Part {
  /** As in the paper. */
  readonly letter: string;
  readonly title: string;
  readonly unit: string;
  /** Shown value = metres × scale. */
  readonly scale: number;
  readonly digits: number;
  readonly lines: readonly Line[];
  /** The axis ends on multiples of this and spans at least two of them, in shown units. */
  readonly grain: number;
  /** Whether the axis starts at zero and shows the threshold of the switching law when the data come near it. */
  readonly threshold: boolean;
}

const POSITION = { unit: 'cm', scale: 100, digits: 0, grain: 5, threshold: false };
const ERROR = { unit: 'cm', scale: 100, digits: 0, grain: 2 };

export const PARTS: readonly Part[] = [
  {
    ...POSITION,
    letter: 'a',
    title: 'x',
    lines: [
      { column: 'tool_x_m', label: 'magnet', color: 'magnet-line' },
      { column: 'bead_x_m', label: 'bead', color: 'bead-line' },
    ],
  },
  {
    ...POSITION,
    letter: 'b',
    title: 'y',
    lines: [
      { column: 'tool_y_m', label: 'magnet', color: 'magnet-line' },
      { column: 'bead_y_m', label: 'bead', color: 'bead-line' },
    ],
  },
  {
    ...ERROR,
    letter: 'c',
    title: 'Error x',
    threshold: false,
    lines: [{ column: 'error_x_m', label: 'ex', color: 'error-x' }],
  },
  {
    ...ERROR,
    letter: 'd',
    title: 'Error y',
    threshold: false,
    lines: [{ column: 'error_y_m', label: 'ey', color: 'error-y' }],
  },
  {
    ...ERROR,
    letter: 'e',
    title: 'Distance e, true',
    grain: 1,
    threshold: true,
    lines: [{ column: 'error_m', label: 'e', color: 'ink' }],
  },
];

/** Letter of the locus. */
export const LOCUS_LETTER = 'f';

/** Ends of an axis: multiples of `grain` around the data, at least two grains apart. */
export function axisRange(min: number, max: number, grain: number): [number, number] {
  let low = Math.floor(min / grain + 1e-6) * grain;
  let high = Math.ceil(max / grain - 1e-6) * grain;
  while (high - low < 2 * grain) {
    low -= grain / 2;
    high += grain / 2;
  }
  return [low, high];
}

/** Of the threshold: data above it bring the threshold on the axis, with some room. */
const [NEAR, ROOM] = [0.5, 1.25];

/** Ends of a part's axis, in shown units. */
export function partRange(
  part: Part,
  lines: readonly Float64Array[],
  threshold_m: number | undefined,
): [number, number] {
  let [min, max] = [Infinity, -Infinity];
  for (const line of lines) {
    for (const value of line) {
      if (value < min) min = value;
      if (value > max) max = value;
    }
  }
  if (min > max) [min, max] = [0, 0];
  if (!part.threshold) return axisRange(min, max, part.grain);
  const threshold = (threshold_m ?? 0) * part.scale;
  const least = max > NEAR * threshold ? ROOM * threshold : 2 * part.grain;
  return axisRange(0, Math.max(max, least), part.grain);
}

/** What is said of a threshold above the axis. */
export function thresholdAbove(
  part: Part,
  threshold_m: number | undefined,
  [, high]: readonly [number, number],
): string | undefined {
  const threshold = (threshold_m ?? 0) * part.scale;
  return part.threshold && threshold > high
    ? `T = ${fixed(threshold, 1)} ${part.unit} above`
    : undefined;
}

/** Values of each line, in shown units. */
export function linesOf(part: Part, sample: Sample | undefined): Float64Array[] {
  return part.lines.map(
    ({ column }) =>
      sample?.columns[column].map((value) => value * part.scale) ?? new Float64Array(),
  );
}

/** The present time is marked only if it is at least this far before the newest sample. */
const BEHIND_S = 0.02;

const RULE = { axis: 'x', label: '', dashed: false } as const;

/** The present time, after a rewind. */
export const presentRules = (sample: Sample): Rule[] =>
  sample.at_s < (sample.columns.sim_time_s.at(-1) ?? 0) - BEHIND_S
    ? [{ ...RULE, at: sample.at_s, color: 'ink', isStrong: true }]
    : [];

/** Disturbances, and the threshold if the axis has it. */
export function rulesOf(
  part: Part,
  sample: Sample | undefined,
  threshold_m: number | undefined,
  range: readonly [number, number],
): Rule[] {
  const rules: Rule[] = (sample?.struck ?? []).map(({ time_s }) => ({
    ...RULE,
    at: time_s,
    color: 'you',
  }));
  if (part.threshold && threshold_m !== undefined && !thresholdAbove(part, threshold_m, range)) {
    const at = threshold_m * part.scale;
    rules.push({ axis: 'y', at, label: 'T', color: 'danger', dashed: true });
  }
  return rules;
}
