// The first visit shows the workspace, the controller and Run. The other panels open on demand and stay as they were left.

import type { Page } from '@playwright/test';
import { Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';

const PANELS = ['Camera', 'Beside the workspace', 'Below the workspace'];
const fold = (page: Page, name: string) => page.getByRole('button', { name, exact: true });
const area_px = async (page: Page, selector: string) => {
  const box = await page.locator(selector).boundingBox();
  return box ? box.width * box.height : 0;
};

test('opens panels on demand, and keeps them', async ({ page, session }) => {
  const lab = await Lab.attach(page, session.url);
  for (const name of PANELS) {
    await expect(fold(page, name)).toHaveAttribute('aria-expanded', 'false');
  }
  await expect(page.getByLabel('Threshold T')).toHaveCount(0);
  const observation = page.getByRole('img', { name: /^Observation/ }).first();
  await expect(observation).toHaveCount(0);
  await expect(lab.button('Run')).toBeVisible();
  expect(await violations(page)).toEqual([]);
  expect(faultsOf(await controls(page), MIN_SIDE_PX.mouse)).toEqual([]);
  const before = await area_px(page, '.workspace');

  await fold(page, 'Camera').click();
  await expect(observation).toBeVisible();
  await expect(page.getByText('No image yet')).toHaveCount(0);
  // A tab opens its panel.
  await page.getByRole('tab', { name: 'Tune' }).click();
  await expect(page.getByLabel('Threshold T').first()).toBeVisible();
  expect(await area_px(page, '.workspace')).toBeLessThan(before);

  await page.reload();
  await lab.live();
  for (const [name, open] of [
    ['Beside the workspace', 'false'],
    ['Below the workspace', 'true'],
  ] as const) {
    await expect(fold(page, name)).toHaveAttribute('aria-expanded', open);
  }
  await expect(page.getByRole('tabpanel', { name: 'Tune' })).toBeVisible();
  await lab.panel('Now');
  await expect(fold(page, 'Camera')).toHaveAttribute('aria-expanded', 'true');
  for (const name of ['Camera', 'Below the workspace']) {
    await fold(page, name).click();
  }
  await expect.poll(() => area_px(page, '.workspace')).toBe(before);
});
