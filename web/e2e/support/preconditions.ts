// Brings the session and the page into a state that a test needs.

import { expect } from '@playwright/test';
import type { Lab } from './lab';
import type { Panel } from './labControls';
import { distance } from './table';
import { until } from './wait';

/** A free point near the bead, away from the current goal. */
export function freePointNearBead(lab: Lab) {
  const points = lab.freePoints(lab.state.bead_m, 0.05, 0.2);
  const goal = lab.state.goal_m;
  return points.find((point) => !goal || distance(point, goal) > 0.03) ?? points[0];
}

export async function ensurePaused(lab: Lab) {
  if (lab.state.running) await lab.pause();
}

export async function ensureRunning(lab: Lab) {
  if (!lab.state.running) await lab.run();
}

export async function ensureGoal(lab: Lab) {
  if (!lab.state.goal_m) await lab.setGoal(freePointNearBead(lab));
}

export async function ensureNoGoal(lab: Lab) {
  if (!lab.state.goal_m) return;
  await lab.button('Clear goal').click();
  await until('no goal', () => !lab.state.goal_m);
}

export async function ensureHistory(lab: Lab) {
  await ensurePaused(lab);
  await lab.step(120);
}

/** Presses the button `name`, unless what it opens is open. */
export const open = (name: string) => async (lab: Lab) => {
  const button = lab.button(name);
  if ((await button.getAttribute('aria-expanded')) === 'false') await button.click();
};

/** Closes *Layers* or *Set up*, which take the place of the tabs. */
export async function showTabs(lab: Lab) {
  const close = lab.page.locator('.inspector-head').getByRole('button', { name: 'Close' });
  if (await close.count()) await close.click();
  await lab.tab('Now').waitFor();
}

/** Shows a panel, also when another one is in the place of the tabs. */
export const showPanel = (name: Panel) => async (lab: Lab) => {
  await showTabs(lab);
  await lab.panel(name);
};

export async function openLayers(lab: Lab) {
  if ((await lab.button('Layers').getAttribute('aria-pressed')) === 'false')
    await lab.button('Layers').click();
}

export const setUpButton = (lab: Lab) => lab.page.getByTitle('Set up: map, preset, seed');

export async function openSetUp(lab: Lab) {
  if ((await setUpButton(lab).getAttribute('aria-expanded')) === 'false')
    await setUpButton(lab).click();
}

/** Opens the 3-D view and waits until it draws. */
export async function openSceneView(lab: Lab) {
  await lab.radio('3-D').check();
  await expect(lab.label('Scene')).toHaveAttribute('data-px-from-table', /\d/, { timeout: 30_000 });
  await lab.drawn();
}
