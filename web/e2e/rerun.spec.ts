// Rerun's viewer in its frame: a recording, colours and focus. Needs the arguments for WebGL.

import { BROWSER, CHROMIUM_ARGUMENTS, SOFTWARE_WEBGL } from './support/browser';
import { type Lab, expect, test } from './fixtures';
import { must, until } from './support/wait';

/** The browser compiles 40 MB of WebAssembly and draws without a graphics card. */
const VIEWER_MS = 90_000;
const MISSING = /there is no recording "none/i;

test.use({
  launchOptions: {
    executablePath: BROWSER,
    args: [...CHROMIUM_ARGUMENTS, ...SOFTWARE_WEBGL],
  },
});

/** A pixel of the viewer's top bar, which is either dark or light. */
async function barPixel(lab: Lab) {
  const box = must(await lab.page.locator('iframe').boundingBox(), 'the viewer');
  const clip = { x: box.x + box.width / 2, y: box.y + 6, width: 2, height: 2 };
  return (await lab.page.screenshot({ clip })).toString('base64');
}

test('opens a recording in Rerun’s viewer', async ({ lab, session, server, watch }) => {
  test.setTimeout(240_000);
  // The viewer warns that there is no graphics card. It must report no errors.
  watch.allow(/^\s*WARN /);
  const { page } = lab;
  // Two trials.
  for (const ticks of [100, 200]) {
    await lab.reset();
    await lab.step(ticks);
  }
  // By keyboard only.
  await lab.view('Recordings').press('Enter');
  const opener = page.getByRole('button', { name: `Open in Rerun: ${session.name}` });
  await opener.press('Enter');
  const body = page.frameLocator('iframe[title="Rerun viewer"]').locator('body');
  await expect(body).toHaveAttribute('data-state', /open|failed/, { timeout: VIEWER_MS });
  await expect(body, await body.innerText()).toHaveAttribute('data-state', 'open');
  // At the beginning, on the time line on which the trials follow each other. It stays there.
  await expect(body).toHaveAttribute('data-timeline', 'recording_time', { timeout: VIEWER_MS });
  await expect(body).toHaveAttribute('data-time', '0', { timeout: VIEWER_MS });
  // The file opens before the viewer is completely drawn. When it is, its bar keeps one colour.
  const light = lab.button('Light');
  const dark = lab.button('Dark');
  await light.click();
  const bright = await steadyBarPixel(lab);
  await dark.click();
  await until('a dark viewer', async () => (await barPixel(lab)) !== bright, VIEWER_MS);
  const dim = await steadyBarPixel(lab);
  await light.click();
  await until('a light viewer', async () => (await barPixel(lab)) === bright, VIEWER_MS);
  await dark.click();
  await until('a dark viewer again', async () => (await barPixel(lab)) === dim, VIEWER_MS);

  await expect(body).toHaveAttribute('data-time', '0');
  await page.locator('iframe').focus();
  await page.keyboard.press('Tab');
  await page.keyboard.press('F6');
  await expect(lab.button('Close'), 'F6 leads out of the viewer').toBeFocused();
  await page.keyboard.press('Enter');
  await expect(page.locator('iframe')).toHaveCount(0);
  await expect(opener, 'the focus returns to the button').toBeFocused();

  expect(watch.messages).toEqual([]);
  watch.allow(/status of 404/);
  await page.goto(`${server.url}/viewer/?recording=none&theme=light`);
  await expect(page.getByText(MISSING)).toBeVisible({ timeout: VIEWER_MS });
});

/** The colour of the bar, once several pictures in a row show the same colour. */
async function steadyBarPixel(lab: Lab) {
  let before: string | undefined;
  let times = 0;
  return until(
    'a viewer that does not change',
    async () => {
      const now = await barPixel(lab);
      times = now === before ? times + 1 : 0;
      before = now;
      return times >= 5 && now;
    },
    VIEWER_MS,
  );
}
