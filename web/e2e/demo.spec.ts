// The demonstration: its programme, and the visitor who interrupts it.

import { Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { useSlowDisplay } from './support/display';
import { Server } from './support/server';
import { until } from './support/wait';

const CAPTION_MS = 60_000;
const SILENCE_MS = 61_000;

test('runs its programme, gives way to a visitor, and returns', async ({ page, watch }) => {
  const server = await Server.start();
  try {
    watch.allowHost(server.url);
    await useSlowDisplay(page);
    const lab = new Lab(page);
    await page.goto(`${server.url}/demo`);
    const caption = page.getByRole('status');
    await expect(caption).toHaveText('A magnet carries a bead through a maze');
    await expect(caption).toHaveText(/^A neural network steers/, { timeout: CAPTION_MS });
    expect(await violations(page)).toEqual([]);
    expect(lab.scene.map).toBe('colon');
    await expect(caption).toHaveText('The bead is pulled away.', { timeout: CAPTION_MS });
    await until('the disturbance', () => lab.state.disturbances === 1);
    await expect(caption).toHaveText(/^Fetched/, { timeout: CAPTION_MS });

    await page.mouse.click(200, 200);
    await expect(caption).toHaveText(/^You are in control/);
    const { trial } = lab.scene;
    // The page's clock, not its timers.
    await page.clock.setFixedTime(Date.now() + SILENCE_MS);
    await until('another experiment', () => lab.scene.trial > trial && lab.state.running);
    expect(lab.state.controller).toBe('errt');

    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Laboratory' }).waitFor();
  } finally {
    // A page that looks for its server would report that it has gone.
    await page.goto('about:blank');
    await server.stop();
  }
});
