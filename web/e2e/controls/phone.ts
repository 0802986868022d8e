// Rows of the control table: the tabs at the foot of a phone, and what has no tab.

import type { Lab } from '../support/lab';
import { type Row, type Section, expanded, isPressed, toggle } from './row';

const foot = (lab: Lab) => lab.page.getByRole('navigation', { name: 'Panels' });
const sheet = async (lab: Lab) => {
  const shown = lab.page.locator('.inspector');
  if ((await shown.count()) === 0) return 'none';
  return shown.locator('[aria-selected=true], h2').first().innerText();
};

/** The map alone. */
async function closeSheet(lab: Lab) {
  await foot(lab).getByRole('button', { name: 'Steer' }).click();
  await lab.page.locator('.inspector').waitFor({ state: 'detached' });
}
const openSheet = (lab: Lab) => foot(lab).getByRole('button', { name: 'Story' }).click();
async function openMore(lab: Lab) {
  await closeSheet(lab);
  await foot(lab).getByRole('button', { name: 'More' }).click();
}

const opens = (ready: Row['ready'] & object): Row => ({ see: sheet, ready });

export const PHONE: Section = {
  name: 'a phone',
  rows: {
    'button Steer': opens(openSheet),
    'button Learn': { ...opens(closeSheet), isToggle: true },
    'button Play': { ...opens(closeSheet), isToggle: true },
    'button Story': { ...opens(closeSheet), isToggle: true },
    ...Object.fromEntries(
      ['Now', 'Compare', 'Recovery', 'Disturb', 'Tune', 'Layers', 'Set up'].map((name) => [
        `button ${name}`,
        opens(openMore),
      ]),
    ),
    'button Step ¼ s': { see: (lab) => lab.state.tick, ready: openMore },
    'button Whole height': toggle(expanded, openSheet),
    'button 3-D': toggle(isPressed),
  },
};
