// The inspector: one panel at a time, which stays as it was left. No panel changes the scale of the map.

import type { Page } from '@playwright/test';
import { Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { panels, plots } from './support/places';
import { must } from './support/wait';

const scale = (lab: Lab) => lab.canvas.getAttribute('data-px-per-m');
const widthOf = async (page: Page) =>
  must(await page.locator('.inspector').boundingBox(), 'the inspector').width;

test('opens panels on demand, and keeps them', async ({ page, session }) => {
  const lab = await Lab.attach(page, session.url);
  const camera = lab.button('Camera');
  await expect(lab.tab('Now')).toHaveAttribute('aria-selected', 'true');
  await expect(camera).toHaveAttribute('aria-expanded', 'false');
  await expect(page.getByLabel('Threshold T')).toHaveCount(0);
  const observation = page.getByRole('img', { name: /^Observation/ }).first();
  await expect(observation).toHaveCount(0);
  await expect(lab.button('Run')).toBeVisible();
  expect(await violations(page)).toEqual([]);
  expect(faultsOf(await controls(page), MIN_SIDE_PX.mouse)).toEqual([]);

  await camera.click();
  await expect(observation).toBeVisible();
  await expect(page.getByText('No image yet')).toHaveCount(0);
  await lab.tab('Tune').click();
  await expect(page.getByLabel('Threshold T').first()).toBeVisible();
  await expect(observation).toHaveCount(0);

  await page.reload();
  await lab.live();
  await expect(page.getByRole('tabpanel', { name: 'Tune' })).toBeVisible();
  await lab.panel('Now');
  await expect(camera).toHaveAttribute('aria-expanded', 'true');
  await camera.click();

  await lab.button('Hide the panel').click();
  await page.reload();
  await lab.live();
  await expect(page.locator('.inspector')).toHaveCount(0);
  await lab.button('Show the panel').click();
  await expect(page.getByRole('tabpanel', { name: 'Now' })).toBeVisible();
});

test('a panel of the top bar gives the last tab back', async ({ lab }) => {
  await lab.panel('Story');
  for (const name of ['Layers', 'Set up']) {
    if (name === 'Layers') await lab.button('Layers').click();
    else await lab.setUp();
    await expect(lab.page.getByRole('heading', { name, exact: true })).toBeVisible();
    await expect(lab.page.getByRole('tablist')).toHaveCount(0);
    await lab.button('Close').click();
    await expect(lab.tab('Story')).toHaveAttribute('aria-selected', 'true');
  }
});

for (const [width, height] of [
  [1280, 800],
  [1920, 1080],
] as const) {
  test(`nothing that opens changes the scale of the map at ${width}×${height}`, async ({ lab }) => {
    const { page } = lab;
    await page.setViewportSize({ width, height });
    await lab.reset();
    const before = must(await scale(lab), 'the scale');
    const map = must(await lab.canvas.boundingBox(), 'the map');
    for (const places of [panels, plots]) {
      for await (const { name } of places(lab)) {
        expect(await scale(lab), name).toBe(before);
        const { x, width: now } = must(await lab.canvas.boundingBox(), name);
        expect([x, now], name).toEqual([map.x, map.width]);
      }
    }
    // The map is then in the middle.
    await lab.button('Hide the panel').click();
    await expect
      .poll(async () => must(await lab.canvas.boundingBox(), 'the map').x)
      .toBeGreaterThan(map.x);
    expect(await scale(lab)).toBe(before);
  });
}

test('the inspector is as wide as its user made it', async ({ lab }) => {
  const { page } = lab;
  await page.setViewportSize({ width: 1600, height: 800 });
  await lab.drawn();
  const before = await widthOf(page);
  const drag = async (by: number) => {
    const { x, y, width, height } = await lab.boxOf(page.locator('.inspector-edge'));
    const at = [x + width / 2, y + height / 2] as const;
    await page.mouse.move(...at);
    await page.mouse.down();
    await page.mouse.move(at[0] + by, at[1], { steps: 4 });
    await page.mouse.up();
  };
  const shown = await scale(lab);
  await drag(-80);
  await expect.poll(() => widthOf(page)).toBeCloseTo(before + 80, -1);
  expect(await scale(lab)).toBe(shown);
  await page.reload();
  await lab.live();
  expect(await widthOf(page)).toBeCloseTo(before + 80, -1);
  // The map keeps its room, and the inspector enough for its text.
  await drag(-1000);
  expect(await scale(lab)).toBe(shown);
  await drag(1200);
  await expect.poll(() => widthOf(page)).toBe(300);
  await page.locator('.inspector-edge').dblclick();
  await expect.poll(() => widthOf(page)).toBe(before);
});
