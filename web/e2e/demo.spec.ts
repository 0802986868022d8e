// The demonstration: its programme, and the visitor who interrupts it.

import type { Page } from '@playwright/test';
import { Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { useSlowDisplay } from './support/display';
import { Server } from './support/server';
import { until } from './support/wait';

const CAPTION_MS = 60_000;
const SILENCE_MS = 61_000;
/** The captions of the first part, in order. */
const CAPTIONS = [
  'A magnet carries a bead through a maze',
  'A neural network steers. It sees only the camera picture.',
  'Watch: the bead will be pulled away.',
  'The bead is pulled away.',
  'Lost. The arm flies straight to the bead.',
  'Fetched. It carries on.',
];

declare global {
  interface Window {
    ferryCaptions: string[];
  }
}

/** Runs in the page before its scripts. A test on a busy machine could miss a caption that it only looks for. */
function keepCaptions() {
  window.ferryCaptions = [];
  new MutationObserver(() => {
    const text = document.querySelector('[role=status]')?.textContent.trim() ?? '';
    if (text !== '' && text !== window.ferryCaptions.at(-1)) window.ferryCaptions.push(text);
  }).observe(document, { subtree: true, childList: true, characterData: true });
}

const captionsOf = (page: Page) => page.evaluate(() => window.ferryCaptions);

test('runs its programme, gives way to a visitor, and returns', async ({ page, watch }) => {
  const server = await Server.start();
  try {
    watch.allowHost(server.url);
    await useSlowDisplay(page);
    await page.addInitScript(keepCaptions);
    const lab = new Lab(page);
    await page.goto(`${server.url}/demo`);
    await until('the first experiment', () => lab.isComplete && lab.scene.map === 'colon');
    expect(await violations(page)).toEqual([]);
    for (const [index, caption] of CAPTIONS.entries()) {
      await until(caption, async () => (await captionsOf(page)).length > index, CAPTION_MS);
    }
    expect((await captionsOf(page)).slice(0, CAPTIONS.length)).toEqual(CAPTIONS);
    expect(lab.state.disturbances).toBe(1);

    await page.mouse.click(200, 200);
    await expect(page.getByRole('status')).toHaveText(/^You are in control/);
    const { trial } = lab.scene;
    // The page's clock, not its timers.
    await page.clock.setFixedTime(Date.now() + SILENCE_MS);
    await until('another experiment', () => lab.scene.trial > trial && lab.state.running);
    await until('the planner', () => lab.state.controller === 'errt');

    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Laboratory' }).waitFor();
  } finally {
    // A page that looks for its server would report that it has gone.
    await page.goto('about:blank');
    await server.stop();
  }
});
