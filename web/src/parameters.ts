// How each parameter is shown and within which range it is asked. The server has the last word.

import type { ControllerName, Parameters } from './protocol.gen';

/** Sub-controllers 2 as the page names them. */
export const CONTROLLER_LABELS: Readonly<Record<ControllerName, string>> = {
  attractor: 'Attractor',
};

type NumberName = {
  [K in keyof Parameters]: Parameters[K] extends number ? K : never;
}[keyof Parameters];
type ChoiceName = Exclude<keyof Parameters, NumberName>;

export interface NumberField {
  readonly kind: 'number';
  readonly name: NumberName;
  readonly label: string;
  readonly help: string;
  readonly unit: string;
  /** Shown value = stored value × scale. */
  readonly scale: number;
  /** In shown units. */
  readonly min: number;
  readonly max: number;
  readonly step: number;
  /** Another parameter that bounds this one from above. */
  readonly atMost?: NumberName;
}

export interface ChoiceField {
  readonly kind: 'choice';
  readonly name: ChoiceName;
  readonly label: string;
  readonly help: string;
  readonly options: readonly (readonly [value: string, label: string])[];
}

export type Field = NumberField | ChoiceField;

export interface Group {
  readonly title: string;
  readonly fields: readonly Field[];
}

function number(
  name: NumberName,
  label: string,
  [min, max, step]: readonly [number, number, number],
  unit: string,
  scale: number,
  help: string,
): NumberField {
  return { kind: 'number', name, label, help, unit, scale, min, max, step };
}

export const GROUPS: readonly Group[] = [
  {
    title: 'Switching',
    fields: [
      {
        kind: 'choice',
        name: 'switching_law',
        label: 'Switching law',
        help: 'With hysteresis, sub-controller 1 keeps control until the bead is fetched; the paper has one threshold both ways.',
        options: [
          ['hysteresis', 'Hysteresis'],
          ['literal', 'Literal (paper)'],
        ],
      },
      number(
        'threshold_m',
        'Threshold T',
        [2, 20, 0.1],
        'cm',
        100,
        'Farther than this from the tool, the bead is lost and sub-controller 1 takes over.',
      ),
      {
        ...number(
          'fetch_radius_m',
          'Fetch radius',
          [0.2, 20, 0.1],
          'cm',
          100,
          'Nearer than this, sub-controller 1 has fetched the bead. Never above T.',
        ),
        atMost: 'threshold_m',
      },
    ],
  },
  {
    title: 'Speeds',
    fields: [
      number(
        'approach_speed_m_s',
        'Approach',
        [20, 250, 1],
        'mm/s',
        1000,
        'Speed of the tool while it goes to the bead.',
      ),
      number(
        'transport_speed_m_s',
        'Transport',
        [10, 79, 1],
        'mm/s',
        1000,
        'Speed of the tool while it carries the bead.',
      ),
    ],
  },
  {
    title: 'Attractor dynamics',
    fields: [
      {
        kind: 'choice',
        name: 'attractor_law',
        label: 'Attractor law',
        help: 'The literal law can stick behind a flat face; the improved one follows contours and keeps clear.',
        options: [
          ['improved', 'Improved'],
          ['literal', 'Literal (paper)'],
        ],
      },
      number('attractor_gain', 'Gain K', [1.05, 10, 0.05], '', 1, 'K = k·I; stable above 1.'),
      number(
        'attractor_safety_factor',
        'Safety factor',
        [1, 2, 0.05],
        '',
        1,
        'Scales the half sides of the superellipse around an obstacle.',
      ),
      number(
        'attractor_reactivity',
        'Reactivity ρ',
        [0.2, 5, 0.1],
        '',
        1,
        'How early the motion bends around an obstacle.',
      ),
      number(
        'attractor_clearance_m',
        'Clearance',
        [0, 30, 1],
        'mm',
        1000,
        'Distance that the improved law keeps from walls.',
      ),
    ],
  },
  {
    title: 'Magnet and bead',
    fields: [
      {
        kind: 'choice',
        name: 'block_orientation',
        label: 'Block',
        help: 'How the block magnet on the tool is turned.',
        options: [
          ['A', 'A: flat, vertical field'],
          ['B', 'B: on edge'],
          ['C', 'C: flat, along 50 mm'],
        ],
      },
      {
        kind: 'choice',
        name: 'tool_orientation',
        label: 'Tool',
        help: "How the arm holds the flange. The paper's rotation vector is 3.2° off the vertical.",
        options: [
          ['vertical', 'Straight down'],
          ['paper', '3.2° off (paper)'],
        ],
      },
      number(
        'tool_height_m',
        'Tool height',
        [90, 200, 1],
        'mm',
        1000,
        'Lower face of the block above the table.',
      ),
      {
        kind: 'choice',
        name: 'bead_motion',
        label: 'Bead',
        help: 'The field holds the bead, so that it slides; or it is free to turn and rolls.',
        options: [
          ['sliding', 'Slides'],
          ['rolling', 'Rolls'],
        ],
      },
      number('friction', 'Friction μ', [0, 1, 0.01], '', 1, 'Coulomb friction of the bead.'),
      number(
        'rolling_resistance',
        'Rolling resistance',
        [0, 0.2, 0.005],
        '',
        1,
        'In units of the normal load; only for a bead that rolls. At μ or above, the bead slides.',
      ),
      number('drag_n_s_m', 'Viscous drag', [0, 100, 1], 'mN·s/m', 1000, 'Drag on the bead.'),
    ],
  },
  {
    title: 'Tracker',
    fields: [
      number(
        'tracker_noise_m',
        'Noise σ',
        [0, 10, 0.1],
        'mm',
        1000,
        'Standard deviation of the tracked position.',
      ),
      number(
        'tracker_latency_ticks',
        'Latency',
        [0, 50, 1],
        'ticks',
        1,
        'Age of the tracked position, in ticks of 8 ms.',
      ),
      number('tracker_dropout', 'Dropout', [0, 90, 1], '%', 100, 'Share of lost samples.'),
    ],
  },
];

/** Digits after the point that `step` asks for. */
export function digits(step: number): number {
  return Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
}

/** From the stored unit to the shown one, free of binary dust. */
export function shownValue(field: NumberField, stored: number): number {
  return Number((stored * field.scale).toPrecision(12));
}

/** From the shown unit to the stored one, inside the field's range. */
export function storedValue(field: NumberField, shown: number, parameters: Parameters): number {
  const inside = Math.min(field.max, Math.max(field.min, shown));
  const stored = Number((inside / field.scale).toPrecision(12));
  return field.atMost ? Math.min(stored, parameters[field.atMost]) : stored;
}
