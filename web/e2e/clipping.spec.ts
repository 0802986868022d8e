// In a small window nothing is cut off, and nothing covers the map.

import type { Locator } from '@playwright/test';
import { type Lab, expect, test } from './fixtures';
import { ensureHistory } from './support/preconditions';
import { must, until } from './support/wait';

const boxOf = async (locator: Locator) => {
  const { x, y, width, height } = must(await locator.boundingBox(), 'a box');
  return { left: x, top: y, right: x + width, bottom: y + height };
};

/** How far a part is outside of the whole, in pixels. */
async function outside(part: Locator, whole: Locator) {
  const [inner, outer] = [await boxOf(part), await boxOf(whole)];
  return Math.max(
    outer.left - inner.left,
    outer.top - inner.top,
    inner.right - outer.right,
    inner.bottom - outer.bottom,
  );
}

/** By how many pixels a part reaches into the map; at most 0 if it is beside it. */
async function overMap(lab: Lab, part: Locator) {
  const [one, map] = [await boxOf(part), await boxOf(lab.canvas)];
  return Math.min(
    Math.min(one.right, map.right) - Math.max(one.left, map.left),
    Math.min(one.bottom, map.bottom) - Math.max(one.top, map.top),
  );
}

test('the pictures of the camera and the tabs are inside the inspector', async ({ lab }) => {
  const { page } = lab;
  await lab.step(1);
  await expect(page.getByTestId('blocks')).toBeVisible();
  const inspector = page.locator('.inspector');
  for (const name of ['Network: image', 'Network: goal, tool']) {
    const picture = page.getByRole('tabpanel', { name: 'Now' }).getByText(name);
    await picture.scrollIntoViewIfNeeded();
    expect(await outside(picture, inspector), name).toBeLessThanOrEqual(0);
  }
  for (const width of [1280, 1100]) {
    await page.setViewportSize({ width, height: 800 });
    for (const tab of await page.getByRole('tab').all())
      expect(await outside(tab, inspector), await tab.innerText()).toBeLessThanOrEqual(0);
  }
});

test('a refusal does not cover the map', async ({ lab }) => {
  await lab.reset({ map: 'posts' });
  const wall = must(lab.scene.walls[0]?.exterior[0], 'a wall');
  await lab.click(wall);
  const notice = lab.notice('workspace').first();
  await expect(notice).toBeVisible();
  expect(await overMap(lab, notice)).toBeLessThanOrEqual(0);
});

test('no menu covers the map, or the button that opens it', async ({ lab }) => {
  const { page } = lab;
  await ensureHistory(lab);
  await lab.reset();
  await until('a kept run', () => lab.scene.kept_runs.length > 0);
  for (const inspector of ['shown', 'hidden']) {
    for (const [name, id, isOfPlots] of [
      ['Share', 'share', false],
      ['More', 'more', false],
      [/^Kept runs/, 'kept-runs', false],
      ['More about plots', 'plot-menu', true],
    ] as const) {
      if (isOfPlots) await lab.button('Plots').click();
      const button = page.getByRole('button', { name, exact: true });
      await button.click();
      const menu = page.locator(`#${id}`);
      await expect(menu).toBeVisible();
      // The map glides.
      await expect
        .poll(() => overMap(lab, menu), { message: `${id}, ${inspector}` })
        .toBeLessThanOrEqual(0);
      expect(await outside(menu, page.locator('html')), id).toBeLessThanOrEqual(0);
      await button.click();
      await expect(menu).toHaveCount(0);
      if (isOfPlots) await lab.button('Plots').click();
    }
    if (inspector === 'shown') await lab.button('Hide the panel').click();
    await lab.drawn();
  }
});
