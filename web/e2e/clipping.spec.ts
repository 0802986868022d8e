// In a small window nothing is cut off, and nothing covers the map.

import type { Locator } from '@playwright/test';
import { expect, test } from './fixtures';
import { must } from './support/wait';

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

test('the pictures of the camera and the tabs are inside their panels', async ({ lab }) => {
  const { page } = lab;
  await lab.step(1);
  await expect(page.getByTestId('blocks')).toBeVisible();
  const camera = page.getByRole('tabpanel', { name: 'Now' });
  for (const name of ['Network: image', 'Network: goal, tool']) {
    expect(await outside(camera.getByText(name), camera), name).toBeLessThanOrEqual(0);
  }
  const lower = page.locator('.panel.lower');
  const last = page.getByRole('tab', { name: 'Challenge' });
  expect(await outside(last, lower)).toBeLessThanOrEqual(0);
  await page.evaluate(() => {
    for (const panel of ['camera', 'lower', 'aside']) {
      localStorage.setItem(`ferry.panel.${panel}`, 'closed');
    }
  });
  await page.reload();
  await lab.live();
  await expect(page.locator('.panel.lower[data-closed]')).toBeVisible();
  expect(await outside(last, lower)).toBeLessThanOrEqual(0);
});

test('a refusal does not cover the map', async ({ lab }) => {
  await lab.reset({ map: 'posts' });
  const wall = must(lab.scene.walls[0]?.exterior[0], 'a wall');
  await lab.click(wall);
  const notice = lab.notice('workspace').first();
  await expect(notice).toBeVisible();
  const [box, canvas] = [await boxOf(notice), await boxOf(lab.canvas)];
  expect(box.top).toBeGreaterThanOrEqual(canvas.bottom);
});
