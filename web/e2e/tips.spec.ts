// The first visit: the scenario that a session opens with, and its tip.

import { Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { Server } from './support/server';
import { until } from './support/wait';

test('opens on a goal in the colon, with a tip', async ({ page, watch }) => {
  const server = await Server.start({ scenario: 'opening' });
  try {
    watch.allowHost(server.url);
    const lab = await Lab.attach(page, server.url);
    expect(lab.scene.map).toBe('colon');
    expect(lab.state.controller).toBe('rl');
    expect(lab.state.running).toBe(false);
    expect(await lab.goal()).toBeDefined();
    await expect(page.locator('.tip span')).toHaveText('Press Run, then drag the bead away.');
    // A lesson has its own task.
    await page.getByRole('tab', { name: 'Learn' }).click();
    await page.getByRole('button', { name: /^Meet the magnet/ }).click();
    await expect(page.locator('.tip')).toHaveCount(0);
    await page.getByRole('button', { name: 'All lessons' }).click();
    await expect(page.locator('.tip')).toBeVisible();
    expect(faultsOf(await controls(page), MIN_SIDE_PX.mouse)).toEqual([]);
    expect(await violations(page)).toEqual([]);
    await lab.run();
    await until('transport', () => lab.state.phase.code === 'transporting');
    await expect(page.locator('.status-words')).toHaveText(
      /^RL carries the bead to the goal[\d.]+ cm to the goal$/,
    );
    await page.goto('about:blank');
  } finally {
    await server.stop();
  }
});
