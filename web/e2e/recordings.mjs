// Recordings: the list, the files, and Rerun's viewer in its frame.

import { readFile } from 'node:fs/promises';
import { Watch, check, startBrowser, until } from './harness.mjs';
import { Lab } from './lab.mjs';

/** Forty megabytes of WebAssembly, compiled and drawn without a graphics card. */
const VIEWER_MS = 90_000;

function rowOf(lab) {
  return lab.page.getByRole('row').filter({ hasText: 'recording now' }).first();
}

export async function listsRecordings({ lab }) {
  await lab.reset({ speed: '8' });
  await lab.click(lab.freePoints(await lab.point('bead'), 0.2, 0.4)[0]);
  await lab.run();
  await until('four seconds', () => lab.state.sim_time_s > 4);
  await lab.pause();

  await lab.button('Recordings').click();
  const row = rowOf(lab);
  await row.waitFor();
  const words = await row.innerText();
  check(/main/.test(words) && /\d+[.,]?\d* [kM]B/.test(words), `the row says: ${words}`);
  check(words.includes(String(new Date().getFullYear())), `no date in: ${words}`);

  const coming = lab.page.waitForEvent('download');
  await row.getByRole('link', { name: 'Download main' }).click();
  const download = await coming;
  check(/-main\.rrd$/.test(download.suggestedFilename()), download.suggestedFilename());
  const bytes = await readFile(await download.path());
  check(bytes.subarray(0, 4).toString() === 'RRF2', 'no recording came down');

  const log = lab.page.waitForEvent('download');
  await row.getByRole('link', { name: 'Download the input log of main' }).click();
  const logged = await readFile(await (await log).path());
  check(logged.subarray(0, 8).toString() === 'ferrylog', 'no input log came down');

  await lab.screenshot('recordings');
  await lab.page.setViewportSize({ width: 820, height: 1180 });
  await lab.screenshot('recordings-tablet');
  await lab.page.setViewportSize({ width: 1280, height: 800 });
  await lab.button('Laboratory').click();
}

/** A pixel of the viewer's top bar, which is either dark or light. */
async function look(lab) {
  const box = await lab.page.locator('iframe').boundingBox();
  const clip = { x: box.x + box.width / 2, y: box.y + 6, width: 2, height: 2 };
  return (await lab.page.screenshot({ clip })).toString('base64');
}

const isFocused = (locator) => locator.evaluate((element) => element === document.activeElement);

export async function opensARecording({ server }) {
  const browser = await startBrowser({ webgl: true });
  const watch = new Watch(browser, server.url);
  try {
    const lab = await Lab.open(browser, server.url);
    const { page } = lab;
    // By keyboard alone.
    await lab.button('Recordings').press('Enter');
    const opener = rowOf(lab).getByRole('button', { name: 'Open main' });
    await opener.press('Enter');
    const body = page.frameLocator('iframe[title="Rerun viewer"]').locator('body');
    await until(
      'the recording in the viewer',
      async () => {
        const state = await body.getAttribute('data-state', { timeout: 60_000 });
        check(state !== 'failed', await body.innerText());
        return state === 'open';
      },
      VIEWER_MS,
    );
    // The file is open before all of the viewer is drawn.
    let dark;
    await until(
      'a viewer that stands still',
      async () => {
        const before = dark;
        dark = await look(lab);
        await page.waitForTimeout(1000);
        return dark === before;
      },
      VIEWER_MS,
    );
    await lab.screenshot('viewer-dark');
    await lab.button('Use light colours').click();
    await until('a light viewer', async () => (await look(lab)) !== dark, VIEWER_MS);
    await lab.screenshot('viewer-light');
    await lab.button('Use dark colours').click();
    await until('a dark viewer', async () => (await look(lab)) === dark, VIEWER_MS);

    await page.locator('iframe').focus();
    await page.keyboard.press('Tab');
    await page.keyboard.press('F6');
    check(await isFocused(lab.button('Close')), 'F6 does not lead out of the viewer');
    await page.keyboard.press('Enter');
    await page.locator('iframe').waitFor({ state: 'detached' });
    check(await isFocused(opener), 'the focus did not return to where it came from');
    check(watch.strangers.length === 0, `requests left the server: ${watch.strangers.join(' ')}`);
    // The viewer warns of what it lacks here, a graphics card; it must have no errors.
    const errors = watch.complaints.filter((text) => !/^\s*WARN /.test(text));
    check(errors.length === 0, `the console says: ${errors.join(' | ')}`);

    await page.goto(`${server.url}/viewer/?recording=none&theme=light`);
    await page.getByText('there is no recording "none').waitFor();
  } finally {
    await browser.close();
  }
}
