// Uploaded maps: a drawing opens, moves into reach, and the bead is delivered on it.

import { type Lab, expect, test } from './fixtures';
import { SECOND_TICKS } from './support/stepper';
import { DRAWING, openMap } from './support/maps';
import { must } from './support/wait';

/** Opens the panel *Set up* and chooses a file there. */
async function openSvg(lab: Lab, drawing: string, name: string) {
  await lab.setUp();
  await openMap(lab.page, () => lab.button('Open SVG…').click(), drawing, name);
}

test('RL delivers on an uploaded map, and the panel says what it was trained on', async ({
  lab,
  server,
}) => {
  const { page } = lab;
  await openSvg(lab, DRAWING, 'Own maze.svg');
  await expect.poll(() => lab.scene.map).toBe('own-maze');
  await lab.setUp();
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
  await lab.button('Layers').click();
  const legend = page.getByRole('group', { name: 'Values' });
  await expect(legend).toContainText('by what the camera has seen so far');
  await expect(legend.getByTestId('value-greatest')).toBeVisible();
  await lab.button('Layers').click();
  await lab.layer('Value', false);
  expect((await page.request.delete(`${server.url}/api/maps/own-maze`)).status()).toBe(204);
  await lab.reset();
});

test('opens an uploaded map, and delivers the bead on it', async ({ lab, server }) => {
  const { page } = lab;
  await lab.map('colon');
  // The map keeps the name of its file.
  const name = 'two-rooms';
  const upload = () => openSvg(lab, DRAWING, 'Two rooms.svg');
  await upload();
  await expect.poll(() => lab.scene.map).toBe(name);
  const report = page.locator('.map-report');
  await expect(report).toContainText('580 × 330 mm, 2 walls.');
  await expect(report).toContainText('The narrowest place is');
  await lab.button('Dismiss the report').click();
  await expect(report).toHaveCount(0);
  expect(lab.scene.walls.length).toBe(2);
  expect(lab.lists.maps).toContain(name);
  await expect(lab.mapChoice(name)).toBeChecked();
  await lab.setUp();
  const stored = await page.request.get(`${server.url}/api/maps/${name}`);
  expect(await stored.text()).toBe(DRAWING);
  await lab.reset({ map: name });
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.2)[0]);
  await lab.deliver();
  const removed = await page.request.delete(`${server.url}/api/maps/${name}`);
  expect(removed.status()).toBe(204);
  await lab.reset();
  await expect.poll(() => lab.lists.maps).not.toContain(name);
  // A deleted name is not given to another drawing.
  await upload();
  await expect.poll(() => lab.scene.map).toMatch(/^map-/);
  await lab.setUp();
  const other = lab.scene.map;
  await lab.map('posts');
  await page.request.delete(`${server.url}/api/maps/${other}`);
});

test('moves a drawing at the arm’s base into its reach', async ({ lab, server }) => {
  const { page } = lab;
  const drawing =
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 -100 300 200"><rect width="50" height="10"/></svg>';
  await openSvg(lab, drawing, 'base.svg');
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
  await lab.setUp();
  await lab.map('posts');
  for (const name of ['base', 'base-moved']) {
    await page.request.delete(`${server.url}/api/maps/${name}`);
  }
});
