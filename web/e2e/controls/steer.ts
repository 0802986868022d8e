// Rows of the control table: the controller You.

import type { Lab } from '../support/lab';
import { showPanel } from '../support/preconditions';
import { until } from '../support/wait';
import { type Section, isChecked, toggle, valueOf } from './row';

const picking = (lab: Lab) => lab.page.getByText('Pick a place').count();

export const STEER: Section = {
  name: 'the controller You',
  ready: async (lab) => {
    await showPanel('Now')(lab);
    await lab.controller('You');
    const clear = lab.button('Clear goal');
    if ((await clear.count()) > 0 && (await clear.isEnabled())) await clear.click();
    await until('no goal', () => !lab.state.goal_m);
  },
  after: (lab) => lab.controller('RL'),
  rows: {
    'radio You': {
      see: (lab) => lab.state.controller,
      ready: (lab) => lab.controller('ERRT'),
      after: (lab) => until('You', () => lab.state.controller === 'you'),
    },
    'checkbox Fetch a lost bead by hand, too': toggle(isChecked),
    'combobox What you see': {
      see: valueOf,
      after: (lab) => lab.label('What you see').selectOption('all'),
    },
    'button Challenges…': {
      see: (lab) => lab.tab('Play').getAttribute('aria-selected'),
      ready: showPanel('Now'),
    },
    // Only with a gamepad.
    'button Choose the stick again': {
      elsewhere: 'a gamepad with an unknown layout rests until its cross was pushed on request',
    },
    'button Set goal': { see: picking, after: (lab) => lab.canvas.press('Escape') },
  },
};
