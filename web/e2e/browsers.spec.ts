// Debian's Firefox and WebKitGTK: open, run, drag, draw and the 3-D view, also with `LANG=C.UTF-8`.

import { mkdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { expect, test } from '@playwright/test';
import { LONG } from './fixtures';
import { OUTPUT } from './support/growth';
import { OTHER_BROWSERS, type OtherBrowser, type Place } from './support/otherBrowsers';
import { Server } from './support/server';
import { flat } from './support/table';

/** The middle of the first element that fits, with exactly this text if one is given. */
const middle = (browser: OtherBrowser, selector: string, text?: string) =>
  browser.read<Place | null>(`(() => {
    const one = [...document.querySelectorAll(${JSON.stringify(selector)})].find(
      (one) => ${JSON.stringify(text ?? null)} === null || one.textContent.trim() === ${JSON.stringify(text ?? '')},
    );
    if (!one) return null;
    one.scrollIntoView({ block: 'nearest' });
    const { left, top, width, height } = one.getBoundingClientRect();
    return [left + width / 2, top + height / 2];
  })()`);

async function click(browser: OtherBrowser, selector: string, text?: string) {
  await expect
    .poll(() => middle(browser, selector, text), `${selector} ${text ?? ''}`)
    .toBeTruthy();
  const at = await middle(browser, selector, text);
  if (at) await browser.drag([at]);
}

/** Where the plan view draws a place given in metres. */
const px = (browser: OtherBrowser, [x, y]: Place) =>
  browser.read<Place>(`(() => {
    const canvas = document.querySelector('.plan-canvas');
    const { left, top } = canvas.getBoundingClientRect();
    const { originX, originY, pxPerM } = canvas.dataset;
    return [left + Number(originX) + ${x} * pxPerM, top + Number(originY) - ${y} * pxPerM];
  })()`);

const bead = async (server: Server) => {
  const answer = await fetch(`${server.url}/api/sessions/other/state`);
  const { bead_m } = (await answer.json()) as { bead_m: readonly [number, number, number] };
  return flat(bead_m);
};

const tick = (browser: OtherBrowser) =>
  browser.read<number>(
    `Number(document.querySelector('[data-testid=tick]')?.textContent.replace(/\\D/g, '') ?? NaN)`,
  );

for (const [name, launch] of Object.entries(OTHER_BROWSERS)) {
  for (const LANG of ['C.UTF-8', 'de_DE.UTF-8']) {
    test(`${name} with LANG=${LANG}`, LONG, async () => {
      const server = await Server.start();
      const browser = await launch({ ...process.env, LANG, LC_ALL: LANG });
      try {
        await browser.open(`${server.url}/s/other`);
        await expect.poll(() => tick(browser), 'the page').toBe(0);

        await click(browser, 'button.run', 'Run');
        await expect.poll(() => tick(browser), 'a running trial').toBeGreaterThan(100);
        await click(browser, 'button.run', 'Pause');

        const from = await bead(server);
        const to: Place = [from[0] + 0.03, from[1]];
        await browser.drag([await px(browser, from), await px(browser, to)]);
        await expect
          .poll(async () => Math.abs((await bead(server))[0] - to[0]), 'a dragged bead')
          .toBeLessThan(0.01);

        await click(browser, 'label', '3-D');
        const scene = `document.querySelector('[data-px-from-table]')`;
        await expect.poll(() => browser.read(`${scene} !== null`), 'the 3-D view').toBe(true);
        await mkdir(OUTPUT, { recursive: true });
        await writeFile(join(OUTPUT, `${name}-${LANG}.png`), await browser.picture());

        await click(browser, 'nav a', 'Draw');
        const isThere = `document.querySelector('.draw-surface') !== null`;
        await expect.poll(() => browser.read(isThere), 'the map editor').toBe(true);
        const surface = await browser.read<Place>(`(() => {
          const { left, top } = document.querySelector('.draw-surface').getBoundingClientRect();
          return [left, top];
        })()`);
        const at = (x: number, y: number): Place => [surface[0] + x, surface[1] + y];
        await browser.drag([at(200, 100), at(300, 120), at(320, 220)]);
        await expect
          .poll(() => browser.read(`document.querySelectorAll('.draw-shape').length`), 'a wall')
          .toBe(1);
      } finally {
        await browser.close();
        await server.stop();
      }
    });
  }
}
