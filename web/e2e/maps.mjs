// A map of one's own: drawn, opened, and refused where it is none.

import { Buffer } from 'node:buffer';
import { check, startBrowser, until } from './harness.mjs';
import { Lab } from './lab.mjs';

const DRAWING = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-300 210 580 330">
  <circle cx="-200" cy="305" r="22"/>
  <rect x="40" y="300" width="60" height="80"/>
</svg>`;

/** Works the button by `press` and gives it a file. */
export async function openMap(page, press, text = DRAWING) {
  const coming = page.waitForEvent('filechooser');
  await press();
  const file = { name: 'mine.svg', mimeType: 'image/svg+xml', buffer: Buffer.from(text) };
  await (await coming).setFiles(file);
}

/** In a browser of its own: that a drawing was refused is an error on the console. */
async function opensADrawing({ server }) {
  const browser = await startBrowser();
  try {
    await drawsItsOwn(await Lab.open(browser, `${server.url}/s/drawing`), server);
  } finally {
    await browser.close();
  }
}

async function drawsItsOwn(lab, server) {
  const { page } = lab;
  const press = () => lab.button('Open map…').click();
  lab.sent.load_scenario = undefined;
  const refusal = lab.notice('transport');
  for (const [text, words] of [
    [DRAWING.replace('viewBox', 'data-box'), 'viewBox'],
    ['no drawing at all', 'map'],
    [DRAWING.replace('</svg>', `<!--${' '.repeat(1024 * 1024)}--></svg>`), '1 MiB'],
  ]) {
    await openMap(page, press, text);
    await refusal.getByText(words).waitFor();
    await refusal.getByRole('button', { name: 'Dismiss' }).click();
  }
  check(!lab.sent.load_scenario, 'what is no map was loaded');

  await page.getByLabel('Map', { exact: true }).selectOption('colon');
  await until('the colon', () => lab.scene.map === 'colon');
  await openMap(page, press);
  await until('the drawing', () => lab.scene.map.startsWith('map-'));
  const name = lab.scene.map;
  check(lab.scene.walls.length === 2, `${name} has ${lab.scene.walls.length} walls, not 2`);
  check(lab.scene.maps.includes(name), `${name} is not among the maps`);
  const shown = () => page.getByLabel('Map', { exact: true }).inputValue();
  await until('its name', async () => (await shown()) === name);
  const kept = await page.request.get(`${server.url}/api/maps/${name}`);
  check((await kept.text()) === DRAWING, 'the server keeps another drawing');
  await lab.screenshot('own-map');
  await lab.reset({ speed: '4', map: name });
  await lab.click(lab.freePoints(await lab.point('bead'), 0.1, 0.2)[0]);
  await lab.run();
  await lab.delivered(1);
  await lab.pause();
  // Others find the maps that they know.
  const gone = await page.request.delete(`${server.url}/api/maps/${name}`);
  check(gone.status() === 204, `the server keeps ${name}: ${gone.status()}`);
  await lab.reset();
  await until('no more of it', () => !lab.scene.maps.includes(name));
}

export const MAPS = [['opens a map of one’s own', opensADrawing]];
