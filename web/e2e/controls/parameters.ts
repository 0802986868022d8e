// Rows of the control table: all parameters, by their label on the page and their name in messages.

import { expect } from '@playwright/test';
import type { InputMethod } from '../support/inputMethods';
import type { ControllerLabel, Lab } from '../support/lab';
import { showPanel } from '../support/preconditions';
import { until } from '../support/wait';
import type { Parameters } from '../support/wire';
import { type Row, type Rows, type Section, toggle } from './row';

type Name = keyof Parameters;
type Role = 'spinbutton' | 'slider' | 'combobox' | 'checkbox';

interface Field {
  readonly name: Name;
  readonly roles: readonly Role[];
}

interface Group {
  readonly name: string;
  readonly controller?: ControllerLabel;
  readonly fields: Record<string, Field>;
}

const number = (name: Name): Field => ({ name, roles: ['spinbutton', 'slider'] });
const choice = (name: Name): Field => ({ name, roles: ['combobox'] });
const flag = (name: Name): Field => ({ name, roles: ['checkbox'] });

const GROUPS: readonly Group[] = [
  {
    name: 'RL',
    controller: 'RL',
    fields: {
      Policy: choice('rl_policy'),
      Shield: flag('rl_shield'),
      'Visit penalty': number('rl_visit_penalty'),
      'Corrected image': flag('rl_corrects_image'),
    },
  },
  {
    name: 'ERRT',
    controller: 'ERRT',
    fields: {
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
  },
  {
    name: 'Attractor dynamics',
    controller: 'Attractor',
    fields: {
      'Attractor law': choice('attractor_law'),
      'Gain K': number('attractor_gain'),
      'Safety factor': number('attractor_safety_factor'),
      'Reactivity ρ': number('attractor_reactivity'),
      Clearance: number('attractor_clearance_m'),
    },
  },
  {
    name: 'Switching',
    fields: {
      'Switching law': choice('switching_law'),
      'Threshold T': number('threshold_m'),
      'Fetch radius': number('fetch_radius_m'),
    },
  },
  {
    name: 'Speeds and steps',
    fields: {
      Approach: number('approach_speed_m_s'),
      Transport: number('transport_speed_m_s'),
      'Step limit': number('step_limit'),
    },
  },
  {
    name: 'Camera',
    fields: {
      'Camera height': number('camera_height_m'),
      'Field of view': number('camera_field_of_view_rad'),
      'Offset x': number('camera_offset_x_m'),
      'Offset y': number('camera_offset_y_m'),
      'Tilt x': number('camera_tilt_x_rad'),
      'Tilt y': number('camera_tilt_y_rad'),
      'Magnet in the picture': flag('camera_sees_magnet'),
      'Image noise σ': number('camera_noise_levels'),
      'Image latency': number('camera_latency_ticks'),
      'Obstacle level': number('obstacle_level'),
      'Smallest block': number('smallest_block_px'),
    },
  },
  {
    name: 'Magnet and bead',
    fields: {
      Block: choice('block_orientation'),
      Tool: choice('tool_orientation'),
      Bead: choice('bead_motion'),
      'Rolling resistance': number('rolling_resistance'),
      'Viscous drag': number('drag_n_s_m'),
    },
  },
  {
    name: 'Walls and fluid',
    fields: {
      Amplitude: number('peristalsis_amplitude_m'),
      Wavelength: number('peristalsis_wavelength_m'),
      Period: number('peristalsis_period_s'),
      Pause: number('peristalsis_pause_s'),
      Kind: choice('peristalsis_contraction'),
      Irregularity: number('peristalsis_irregularity'),
      Flow: number('flow_m_s'),
      'Obstacle memory': number('obstacle_memory_s'),
    },
  },
  {
    name: 'Tracker',
    fields: {
      'Noise σ': number('tracker_noise_m'),
      Latency: number('tracker_latency_ticks'),
      Dropout: number('tracker_dropout'),
      'Bias x': number('tracker_bias_x_m'),
      'Bias y': number('tracker_bias_y_m'),
      'Drift σ': number('tracker_drift_m'),
      'Hidden by the arm': flag('tracker_is_hidden_by_arm'),
      Timeout: number('tracker_timeout_s'),
    },
  },
];

/** Restores the defaults with the input method of the test. */
async function restore(lab: Lab, input: InputMethod) {
  await input.press(lab.button('Restore defaults'));
  await until('the defaults', () => {
    const { defaults, parameters } = lab.scene;
    return JSON.stringify(parameters) === JSON.stringify(defaults);
  });
}

/** Parameters that limit another one. It changes with them, and its name then ends in a dot. */
const LIMITING: readonly Name[] = ['errt_goal_probability', 'threshold_m'];

/** A control of one parameter. */
export const bound = (name: Name): Row => ({
  see: (lab) => lab.scene.parameters[name],
  ...(LIMITING.includes(name) ? { after: restore } : {}),
});

const preset = (name: Name): Row => ({
  see: (lab) => lab.scene.parameters[name],
  after: (lab) => lab.restoreDefaults(),
});

export const PRESETS: Section = {
  name: 'presets of parameters',
  ready: showPanel('Tune'),
  rows: {
    'button Restore defaults': {
      see: (lab) => lab.scene.parameters.threshold_m,
      ready: async (lab) => {
        await lab.tune('Threshold T', '8');
        await until('another threshold', () => lab.scene.parameters.threshold_m === 0.08);
      },
    },
    'combobox Sensors': preset('tracker_dropout'),
    'combobox Camera mount': preset('camera_sees_magnet'),
    'combobox Robot': preset('friction'),
    'combobox Walls': preset('peristalsis_amplitude_m'),
  },
};

function rowsOf(fields: Record<string, Field>): Rows {
  const rows: Rows = {};
  for (const [label, { name, roles }] of Object.entries(fields)) {
    for (const role of roles) {
      rows[`${role} ${role === 'slider' ? `${label} slider` : label}`] = bound(name);
    }
  }
  return rows;
}

const summaryOf = (lab: Lab, name: string) =>
  lab.page.locator('summary').filter({ hasText: new RegExp(`^${name}( ?\\d+ changed)?$`) });

/** Groups that have a field of every kind. */
const GROUPS_OF_EVERY_KIND = ['RL', 'Switching'];

const sectionOf = ({ name, controller, fields }: Group): Section => ({
  name: `parameters: ${name}`,
  ready: async (lab) => {
    await showPanel('Tune')(lab);
    if (controller) await lab.controller(controller);
    const summary = summaryOf(lab, name);
    const isOpen = () => summary.evaluate((one) => (one.parentElement as HTMLDetailsElement).open);
    if (!(await isOpen())) await summary.click();
    await expect.poll(isOpen).toBe(true);
  },
  rows: {
    [`summary ${name}`]: toggle((_lab, locator) =>
      locator.evaluate((one) => (one.parentElement as HTMLDetailsElement).open),
    ),
    ...rowsOf(fields),
  },
  after: restore,
});

export const PARAMETERS = GROUPS.map(sectionOf);

/** All fields of a kind are one component, so an input method need not use each of them. */
export const SOME_PARAMETERS = GROUPS.filter(({ name }) => GROUPS_OF_EVERY_KIND.includes(name)).map(
  sectionOf,
);
