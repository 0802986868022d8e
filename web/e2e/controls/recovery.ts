// Rows of the control table: recovery maps.

import type { Lab } from '../support/lab';
import { chooseSmall, isDone, makeMap, startMap } from '../support/recovery';
import { type Section, downloads, isChecked, lastSent, valueOf } from './row';

const card = (lab: Lab) => lab.page.getByTestId('recovery-cell').count();
const chosen = (lab: Lab) => lab.page.locator('.cell.chosen').first().getAttribute('data-cell');

async function chooseCell(lab: Lab) {
  await lab.page.locator('[role=application] > .cell').first().click();
  await lab.page.getByTestId('recovery-cell').waitFor();
}

/** How many maps there are, once there is a choice. */
const maps = (lab: Lab) => lab.label('Recovery map').locator('option').count();
/** The shown map, by its progress line. */
const shown = (lab: Lab) => lab.text('recovery-progress');

export const RECOVERY: Section = {
  name: 'recovery maps',
  ready: (lab) => makeMap(lab),
  rows: {
    'combobox Disturbance': { see: valueOf },
    'spinbutton Directions': { see: valueOf },
    'spinbutton Columns': {
      see: valueOf,
      ready: (lab) => lab.label('Disturbance').selectOption('place'),
    },
    'spinbutton Times': {
      see: valueOf,
      ready: (lab) => lab.label('Disturbance').selectOption('blind'),
    },
    'spinbutton Repeats': { see: valueOf },
    'spinbutton In time': { see: valueOf },
    'spinbutton Noise seed': { see: valueOf },
    'checkbox Try RL': { see: isChecked, isToggle: true },
    'checkbox Try ERRT': { see: isChecked, isToggle: true },
    'checkbox Try Attractor': { see: isChecked, isToggle: true },
    'application /: cells\\. Arrow keys/': {
      see: chosen,
      ready: chooseCell,
      act: async (_input, locator) => locator.press('ArrowRight'),
    },
    'button /^(ERRT|Attractor) *\\d+ %/': {
      see: (_lab, locator) => locator.getAttribute('aria-pressed'),
      ready: (lab) => lab.page.locator('.recovery-thumb').last().click(),
    },
    'combobox Show': { see: valueOf },
    'button /^Map from/': {
      see: maps,
      ready: (lab) => chooseSmall(lab),
      after: isDone,
    },
    'combobox Recovery map': { see: valueOf },
    'link HTML': { see: downloads },
    'link CSV': { see: downloads },
    'button /^Save trial 1 as/': { see: downloads, ready: chooseCell },
    'button /^Set up trial 1/': {
      see: lastSent('open_try'),
      ready: async (lab) => {
        lab.sent = {};
        if ((await card(lab)) === 0) await chooseCell(lab);
      },
    },
    'button Cancel map': {
      see: async (lab) => (await shown(lab)).includes('cancelled'),
      ready: async (lab) => {
        await startMap(lab);
        await lab.button('Cancel map').waitFor();
      },
    },
  },
};
