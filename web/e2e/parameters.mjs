// The parameters as rows of the table of controls: each by the name on the page and on the wire.

import { until } from './harness.mjs';

const number = (name) => ({ name, roles: ['spinbutton', 'slider'] });
const choice = (name) => ({ name, roles: ['combobox'] });
const flag = (name) => ({ name, roles: ['checkbox'] });

const GROUPS = [
  ['RL', 'RL', { Policy: choice('rl_policy'), Shield: flag('rl_shield') }],
  [
    'ERRT',
    'ERRT',
    {
      'Goal probability': number('errt_goal_probability'),
      'Waypoint probability': number('errt_waypoint_probability'),
      Waypoints: number('errt_waypoints'),
      'Most β': number('errt_beta_most'),
      'Edge length': number('errt_step_m'),
      Clearance: number('errt_clearance_m'),
      'Paths compared': number('errt_ways'),
      'Unseen weight': number('errt_unseen_weight'),
      'Edges per step': number('errt_nodes_per_step'),
      Shortcuts: flag('errt_shortcut'),
    },
  ],
  [
    'Attractor dynamics',
    'Attractor',
    {
      'Attractor law': choice('attractor_law'),
      'Gain K': number('attractor_gain'),
      'Safety factor': number('attractor_safety_factor'),
      'Reactivity ρ': number('attractor_reactivity'),
      Clearance: number('attractor_clearance_m'),
    },
  ],
  [
    'Switching',
    undefined,
    {
      'Switching law': choice('switching_law'),
      'Threshold T': number('threshold_m'),
      'Fetch radius': number('fetch_radius_m'),
    },
  ],
  [
    'Speeds',
    undefined,
    { Approach: number('approach_speed_m_s'), Transport: number('transport_speed_m_s') },
  ],
  [
    'Camera',
    undefined,
    {
      'Camera height': number('camera_height_m'),
      'Field of view': number('camera_field_of_view_rad'),
      'Offset x': number('camera_offset_x_m'),
      'Offset y': number('camera_offset_y_m'),
      'Tilt x': number('camera_tilt_x_rad'),
      'Tilt y': number('camera_tilt_y_rad'),
      'Magnet in the picture': flag('camera_sees_magnet'),
      'Obstacle level': number('obstacle_level'),
      'Smallest block': number('smallest_block_px'),
    },
  ],
  [
    'Magnet and bead',
    undefined,
    {
      Block: choice('block_orientation'),
      Tool: choice('tool_orientation'),
      'Tool height': number('tool_height_m'),
      Bead: choice('bead_motion'),
      'Friction μ': number('friction'),
      'Rolling resistance': number('rolling_resistance'),
      'Viscous drag': number('drag_n_s_m'),
    },
  ],
  [
    'Tracker',
    undefined,
    {
      'Noise σ': number('tracker_noise_m'),
      Latency: number('tracker_latency_ticks'),
      Dropout: number('tracker_dropout'),
    },
  ],
];

const isDefault = ({ scene }) =>
  Object.entries(scene.defaults).every(([name, value]) => scene.parameters[name] === value);

/** By whatever hand changed something. */
async function restore(lab, hand) {
  await hand.press(lab.button('Restore defaults'));
  await until('the defaults', () => isDefault(lab));
}

/** A control of one parameter: it follows, and the defaults can be had again. */
export const bound = (name) => ({ see: (lab) => lab.scene.parameters[name], after: restore });

function rowsOf(fields) {
  const rows = {};
  for (const [label, { name, roles }] of Object.entries(fields)) {
    for (const role of roles) {
      const own = role === 'slider' ? `${label} slider` : label;
      rows[`${role} ${own}`] = bound(name);
    }
  }
  return rows;
}

export const PARAMETERS = GROUPS.map(([group, controller, fields]) => ({
  group,
  controller,
  rows: rowsOf(fields),
}));

export const RESTORE = {
  see: (lab) => lab.scene.parameters.threshold_m,
  ready: async (lab) => {
    const field = lab.page.getByRole('spinbutton', { name: 'Threshold T' });
    await field.fill('8');
    await field.press('Enter');
    await until('another threshold', () => lab.scene.parameters.threshold_m === 0.08);
  },
};
