// Every parameter of the form, in groups.

import { ERRT_FIELDS } from './errtFields';
import { type Group, number } from './parameters';

const DEGREES = 180 / Math.PI;

export const GROUPS: readonly Group[] = [
  {
    title: 'RL',
    controller: 'rl',
    open: true,
    fields: [
      {
        kind: 'choice',
        name: 'rl_policy',
        label: 'Policy',
        help: 'Which trained policy runs. Auto takes the one trained on this map, else the general one.',
        options: [
          ['auto', 'Auto: by map'],
          ['colon', 'Colon'],
          ['general', 'General'],
        ],
      },
      {
        kind: 'flag',
        name: 'rl_shield',
        label: 'Shield',
        help: 'Where the best step comes near a wall in view, the next best is taken. Without, such a step is refused and the arm holds.',
      },
    ],
  },
  {
    title: 'ERRT',
    controller: 'errt',
    fields: ERRT_FIELDS,
  },
  {
    title: 'Attractor dynamics',
    controller: 'attractor',
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
    title: 'Switching',
    open: true,
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
        atMost: ({ threshold_m }) => threshold_m,
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
    title: 'Camera',
    fields: [
      number('camera_height_m', 'Camera height', [10, 100, 0.1], 'cm', 100, 'Above the table.'),
      number(
        'camera_field_of_view_rad',
        'Field of view',
        [6, 68, 0.01],
        '°',
        DEGREES,
        'Angle across the picture: 36.87° sees 20 cm of table from 30 cm above.',
      ),
      number(
        'camera_offset_x_m',
        'Offset x',
        [-15, 15, 0.1],
        'cm',
        100,
        'From the tool to the camera.',
      ),
      number(
        'camera_offset_y_m',
        'Offset y',
        [-15, 15, 0.1],
        'cm',
        100,
        'From the tool to the camera.',
      ),
      number(
        'camera_tilt_x_rad',
        'Tilt x',
        [-22, 22, 0.1],
        '°',
        DEGREES,
        'How far the camera leans toward +x. A leaning picture is rectified before it is used.',
      ),
      number(
        'camera_tilt_y_rad',
        'Tilt y',
        [-22, 22, 0.1],
        '°',
        DEGREES,
        'How far the camera leans toward +y.',
      ),
      {
        kind: 'flag',
        name: 'camera_sees_magnet',
        label: 'Magnet in the picture',
        help: 'As before a real camera: what the magnet hides is not seen.',
      },
      number(
        'obstacle_level',
        'Obstacle level',
        [50, 199, 1],
        '',
        1,
        'Gray at or below this is an obstacle for blocks and map. Walls are 50 or darker.',
      ),
      number(
        'smallest_block_px',
        'Smallest block',
        [1, 240, 1],
        'px',
        1,
        "Smallest side of the quadtree's blocks. The paper's figures have 50.",
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
