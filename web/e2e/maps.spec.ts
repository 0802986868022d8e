// Uploaded maps: a valid drawing opens, other files are refused.

import { expect, test } from './fixtures';
import { dropFile } from './support/drop';
import { SECOND_TICKS } from './support/stepper';
import { DRAWING, openMap } from './support/maps';
import { must } from './support/wait';

const REFUSED: Record<string, { text: string; words: string }> = {
  'a drawing without a view box': {
    text: DRAWING.replace('viewBox', 'data-box'),
    words: 'viewBox',
  },
  'a text file': { text: 'no drawing at all', words: 'this is not an SVG' },
  'a drawing that is too large': {
    text: DRAWING.replace('</svg>', `<!--${' '.repeat(1024 * 1024)}--></svg>`),
    words: '1 MiB',
  },
};

for (const [what, { text, words }] of Object.entries(REFUSED)) {
  test(`refuses ${what} as a map`, async ({ lab, watch }) => {
    watch.allow(/Failed to load resource: .* 4\d\d /);
    await openMap(lab.page, () => lab.button('Open map…').click(), text);
    const refusal = lab.notice('transport');
    await expect(refusal.getByText(words)).toBeVisible();
    await refusal.getByRole('button', { name: 'Dismiss' }).click();
    expect(lab.sent.load_scenario).toBeUndefined();
  });
}

test('RL delivers on an uploaded map, and the panel says what it was trained on', async ({
  lab,
  server,
}) => {
  const { page } = lab;
  await openMap(page, () => lab.button('Open map…').click(), DRAWING, 'Own maze.svg');
  await expect.poll(() => lab.scene.map).toBe('own-maze');
  await lab.reset({ map: 'own-maze' });
  await lab.controller('RL');
  await lab.setGoal(must(lab.freePoints(await lab.bead(), 0.2, 0.4).at(-1), 'a goal'));
  await lab.step(2 * SECOND_TICKS);
  await expect(page.getByTestId('rl-policy')).toHaveText('explorer');
  await expect(page.getByTestId('rl-trained-on')).toContainText('tubes');
  await expect(page.getByTestId('rl-shortcut')).toBeVisible();
  await expect(page.getByTestId('rl-memory')).toContainText('what the camera has seen');
  await lab.deliver();
  // The values are those of the observed area.
  await lab.layer('Value');
  const legend = page.getByRole('group', { name: 'Values' });
  await expect(legend).toContainText('by what the camera has seen so far');
  await expect(legend.getByTestId('value-greatest')).toBeVisible();
  await lab.layer('Value', false);
  expect((await page.request.delete(`${server.url}/api/maps/own-maze`)).status()).toBe(204);
  await lab.reset();
});

test('opens an uploaded map, and delivers the bead on it', async ({ lab, server }) => {
  const { page } = lab;
  await lab.map('colon');
  // The map keeps the name of its file.
  const name = 'two-rooms';
  const upload = () =>
    openMap(page, () => lab.button('Open map…').click(), DRAWING, 'Two rooms.svg');
  await upload();
  await expect.poll(() => lab.scene.map).toBe(name);
  const report = page.locator('.map-report');
  await expect(report).toContainText('580 × 330 mm, 2 walls.');
  await expect(report).toContainText('The narrowest place is');
  await lab.button('Dismiss the report').click();
  await expect(report).toHaveCount(0);
  expect(lab.scene.walls.length).toBe(2);
  expect(lab.scene.maps).toContain(name);
  await expect(lab.label('Map')).toHaveValue(name);
  const stored = await page.request.get(`${server.url}/api/maps/${name}`);
  expect(await stored.text()).toBe(DRAWING);
  await lab.reset({ map: name });
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.2)[0]);
  await lab.deliver();
  const removed = await page.request.delete(`${server.url}/api/maps/${name}`);
  expect(removed.status()).toBe(204);
  await lab.reset();
  await expect.poll(() => lab.scene.maps).not.toContain(name);
  // A deleted name is not given to another drawing.
  await upload();
  await expect.poll(() => lab.scene.map).toMatch(/^map-/);
  const other = lab.scene.map;
  await lab.map('posts');
  await page.request.delete(`${server.url}/api/maps/${other}`);
});

test('takes a drawing that is dropped in another view', async ({ lab, openLab, server }) => {
  const { page } = lab;
  const drop = (onto: typeof page) => dropFile(onto, 'Dropped.SVG', 'image/svg+xml', DRAWING);
  const viewer = await openLab();
  await viewer.isRole('viewer');
  await viewer.view('Evaluate').click();
  await drop(viewer.page);
  await expect(viewer.notice('transport')).toContainText('Take control to open a map.');

  await lab.view('Recordings').click();
  await drop(page);
  await expect.poll(() => lab.scene.map).toBe('dropped');
  await expect(page.locator('.map-report')).toContainText('580 × 330 mm, 2 walls.');
  await expect(lab.view('Laboratory')).toHaveAttribute('aria-current', 'page');
  await lab.button('Dismiss the report').click();
  await lab.map('posts');
  await page.request.delete(`${server.url}/api/maps/dropped`);
});

test('moves a drawing at the arm’s base into its reach', async ({ lab, server }) => {
  const { page } = lab;
  const drawing =
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 -100 300 200"><rect width="50" height="10"/></svg>';
  await openMap(page, () => lab.button('Open map…').click(), drawing, 'base.svg');
  const report = page.locator('.map-report');
  await expect(report).toContainText(/The arm reaches \d+ % of the free area/);
  await report.getByRole('button', { name: 'Move into reach' }).click();
  await expect.poll(() => lab.scene.map).toBe('base-moved');
  await expect(report).toContainText('300 × 200 mm, 1 wall.');
  await expect(report).not.toContainText('The arm reaches');
  const { x_min_m, x_max_m, y_min_m, y_max_m } = lab.scene.workspace;
  const corners_m = [x_min_m, x_max_m, y_min_m, y_max_m].map((side) => Number(side.toFixed(3)));
  expect(corners_m).toEqual([-0.16, 0.14, -0.475, -0.275]);
  await lab.button('Dismiss the report').click();
  await lab.map('posts');
  for (const name of ['base', 'base-moved']) {
    await page.request.delete(`${server.url}/api/maps/${name}`);
  }
});
