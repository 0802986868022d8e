// The parts of the paper's figure: five over time, and the locus in the plane.

import type { Column } from '../../lab/history';
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
  /** Whether the axis starts at zero and shows the threshold of the switching law. */
  readonly threshold: boolean;
}

const POSITION = { unit: 'm', scale: 1, digits: 2, grain: 0.05, threshold: false };
const ERROR = { unit: 'cm', scale: 100, digits: 0, grain: 2 };

export const PARTS: readonly Part[] = [
  {
    ...POSITION,
    letter: 'a',
    title: 'x',
    lines: [
      { column: 'tool_x_m', label: 'tool', color: 'tool' },
      { column: 'bead_x_m', label: 'bead', color: 'bead' },
    ],
  },
  {
    ...POSITION,
    letter: 'b',
    title: 'y',
    lines: [
      { column: 'tool_y_m', label: 'tool', color: 'tool' },
      { column: 'bead_y_m', label: 'bead', color: 'bead' },
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
    title: 'Error norm',
    threshold: true,
    lines: [{ column: 'error_m', label: 'e', color: 'text' }],
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

/** Ends of a part's axis, in shown units; `threshold_m` is part of what an axis with a threshold shows. */
export function partRange(
  part: Part,
  min: number,
  max: number,
  threshold_m: number | undefined,
): [number, number] {
  if (!part.threshold) return axisRange(min, max, part.grain);
  return axisRange(0, Math.max(max, (threshold_m ?? 0) * part.scale * 1.25), part.grain);
}
