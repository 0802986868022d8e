// Recovery maps in browser tests.

import { expect } from '@playwright/test';
import type { Lab } from './lab';
import { ensureGoal, ensurePaused } from './preconditions';

/** Jobs have a low priority, and other tests run at the same time. */
const MAPPED_MS = 90_000;

export const progress = (lab: Lab) => lab.page.getByTestId('recovery-progress');
export const cells = (lab: Lab) => lab.page.locator('[role=application] > .cell');

/** Chooses a small map: places, ERRT and Attractor. */
export async function chooseSmall(lab: Lab, repeats = '1') {
  await lab.panel('Recovery');
  await lab.label('Disturbance').selectOption('place');
  await lab.label('Columns').fill('4');
  await lab.label('Repeats').fill(repeats);
  await lab.label('Try RL').uncheck();
}

export const isDone = (lab: Lab) =>
  expect(progress(lab)).toHaveText(/: \d+ trials$/, { timeout: MAPPED_MS });

/** A small map from the shown moment, as it is started. */
export async function startMap(lab: Lab, repeats?: string) {
  await ensurePaused(lab);
  await ensureGoal(lab);
  await chooseSmall(lab, repeats);
  await lab.page.getByRole('button', { name: /^Map from/ }).click();
}

/** The same, when it is done. */
export async function makeMap(lab: Lab, repeats?: string) {
  await startMap(lab, repeats);
  await isDone(lab);
  await expect(lab.page.locator('.recovery-thumb')).toHaveCount(2);
}
