// The map editor: draw a maze, check it, use it, share it.

import { readFile } from 'node:fs/promises';
import { expect } from '@playwright/test';
import { test } from './fixtures';
import { check, drawAlong } from './support/drawing';
import { showTabs } from './support/preconditions';
import { must, until } from './support/wait';

/** Five trials on a busy machine, after others. */
const TRIED_MS = 90_000;

test('draws a maze, corrects what the check finds, and RL delivers on it', async ({
  lab,
  server,
}) => {
  const { page } = lab;
  await lab.view('Draw').click();
  await expect(check(lab)).toContainText('580 × 330 mm, 0 walls.');
  // From border to border: two regions.
  await drawAlong(page, [-10, 210], [0, 380], [-5, 540]);
  await expect(check(lab)).toContainText('2 separate regions');
  // A door, first too narrow, then wide enough.
  await lab.radio('Erase').click();
  await page.getByRole('slider', { name: 'Width' }).fill('30');
  await drawAlong(page, [-40, 380], [40, 380]);
  await expect(check(lab)).not.toContainText('regions');
  await expect(check(lab)).toContainText('tested in channels from 35 mm');
  await expect(page.getByTestId('passage')).toHaveText(/^(29|30|31) mm$/);
  await page.getByRole('slider', { name: 'Width' }).fill('70');
  await drawAlong(page, [-40, 380], [40, 380]);
  await expect(check(lab)).not.toContainText('tested in channels');
  // A reload loses nothing.
  await page.reload();
  await lab.live();
  await lab.view('Draw').click();
  await expect(page.locator('.draw-shape')).toHaveCount(2);
  await page.getByLabel('Name').fill('Two halves');
  await lab.button('Save and use').click();
  await expect.poll(() => lab.scene.map).toBe('two-halves');
  await expect(page.locator('.map-report')).toContainText('2 walls');
  await lab.button('Dismiss the report').click();
  await lab.reset({ map: 'two-halves' });
  await lab.controller('RL');
  const bead = await lab.bead();
  const other = lab.freePoints(bead, 0.15, 0.5).filter(([x]) => x < -0.01 !== bead[0] < -0.01);
  await lab.setGoal(must(other.at(-1), 'a goal on the other side'));
  await lab.deliver();
  await lab.reset({ map: 'posts' });
  expect((await page.request.delete(`${server.url}/api/maps/two-halves`)).status()).toBe(204);
});

test('goes on with a shipped map, undoes, and downloads what the server reads', async ({
  lab,
  server,
}) => {
  const { page } = lab;
  await lab.view('Draw').click();
  await page.getByLabel('Begin with').selectOption('posts');
  await expect(check(lab)).toContainText('9 walls');
  await lab.button('Mirror left and right').click();
  await page.keyboard.press('Control+z');
  await lab.radio('Post').click();
  await drawAlong(page, [0, 375], [0.1, 375]);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+Shift+z');
  const downloading = page.waitForEvent('download');
  await lab.button('Download SVG').click();
  const file = await readFile(await (await downloading).path(), 'utf8');
  const answer = await page.request.post(`${server.url}/api/map-checks`, {
    data: file,
    headers: { 'content-type': 'image/svg+xml' },
  });
  expect(await answer.json()).toMatchObject({ walls: 10, regions: 1, repairs: [] });
});

test('keeps what is begun, over a visit to the laboratory and in the saved map', async ({
  lab,
  server,
}) => {
  const { page } = lab;
  const shapes = page.locator('.draw-shape:not(.begun)');
  await lab.view('Draw').click();
  await drawAlong(page, [-100, 300], [-100, 400]);
  // Escape ends a drag: what follows of it draws nothing.
  const floor = must(await page.locator('.draw-floor').boundingBox(), 'the floor');
  const at = (right: number, down: number) =>
    [floor.x + right * floor.width, floor.y + down * floor.height] as const;
  await page.mouse.move(...at(0.5, 0.2));
  await page.mouse.down();
  await page.mouse.move(...at(0.5, 0.5), { steps: 3 });
  await page.keyboard.press('Escape');
  await page.mouse.move(...at(0.5, 0.8), { steps: 3 });
  await page.mouse.up();
  await expect(shapes).toHaveCount(1);
  await page.mouse.click(...at(0.7, 0.2));
  await page.mouse.click(...at(0.7, 0.6));
  await page.getByLabel('Name').fill('kept');
  await lab.view('Lab').click();
  await lab.view('Draw').click();
  await expect(page.locator('.draw-corner')).toHaveCount(2);
  await expect(page.getByLabel('Name')).toHaveValue('kept');
  await lab.button('Save and use').click();
  await expect.poll(() => lab.scene.map).toBe('kept');
  expect(lab.scene.walls).toHaveLength(2);
  await lab.button('Dismiss the report').click();
  await lab.view('Draw').click();
  await lab.button('Undo').click();
  await lab.button('Undo').click();
  await expect(shapes).toHaveCount(0);
  await lab.view('Lab').click();
  await lab.reset({ map: 'posts' });
  expect((await page.request.delete(`${server.url}/api/maps/kept`)).status()).toBe(204);
});

test('a drawing brings its start and goal, and the shipped policies are tried on it', async ({
  lab,
  server,
}) => {
  const { page } = lab;
  await lab.view('Draw').click();
  await drawAlong(page, [-100, 215], [-100, 450]);
  await lab.radio('Start').click();
  await drawAlong(page, [-220, 300], [-100, 300]);
  await expect(check(lab)).toContainText('The start is in a wall');
  await expect(lab.button('Save and use')).toBeDisabled();
  await drawAlong(page, [-100, 300], [-220, 300]);
  await lab.radio('Goal').click();
  await drawAlong(page, [200, 400], [200, 450]);
  await page.getByLabel('Name').fill('marked');
  await lab.button('Save and use').click();
  await until('the map', () => lab.scene.map === 'marked' && lab.state.goal_m);
  expect(await lab.goal()).toEqual([0.2, -0.45]);
  expect(lab.scene.scenario.start_m).toEqual([-0.22, -0.3]);
  const trials = page.getByRole('list', { name: 'Shipped policies on this map' });
  await expect(trials).toContainText('explorer solves this map: 5 of 5 trials', {
    timeout: TRIED_MS,
  });
  await lab.button('Let explorer carry').click();
  await until('RL', () => lab.state.controller === 'rl');
  expect(lab.scene.parameters.rl_policy).toBe('explorer');
  await lab.deliver();
  await showTabs(lab);
  await lab.restoreDefaults();
  await lab.reset({ map: 'posts' });
  expect((await page.request.delete(`${server.url}/api/maps/marked`)).status()).toBe(204);
});

test('a link brings a drawn map to a server that does not have it', async ({ lab, server }) => {
  const { page } = lab;
  await lab.view('Draw').click();
  await drawAlong(page, [-100, 300], [0, 400], [100, 300]);
  await page.getByLabel('Name').fill('vee');
  await lab.button('Save and use').click();
  await expect.poll(() => lab.scene.map).toBe('vee');
  await lab.button('Dismiss the report').click();
  await lab.button('Share').click();
  const field = page.getByLabel('Link: A copy for each');
  await expect(field).toHaveValue(/&drawing=[\w-]+$/);
  const hash = new URL(await field.inputValue()).hash;
  const svg = await (await page.request.get(`${server.url}/api/maps/vee`)).text();
  await page.keyboard.press('Escape');
  const load = () =>
    page.evaluate((link) => {
      location.hash = '';
      location.hash = link;
    }, hash);
  // While the map is here, the link does not add it again.
  await lab.reset({ map: 'posts' });
  await load();
  await expect.poll(() => lab.scene.map).toBe('vee');
  await lab.reset({ map: 'posts' });
  expect((await page.request.delete(`${server.url}/api/maps/vee`)).status()).toBe(204);
  await expect.poll(() => lab.lists.maps?.includes('vee')).toBe(false);
  // Otherwise the page still asks for its drawing.
  await lab.drawn();
  // The name of a deleted map is not given again.
  await load();
  await expect.poll(() => lab.scene.map).toMatch(/^map-\d+$/);
  const added = lab.scene.map;
  expect(await (await page.request.get(`${server.url}/api/maps/${added}`)).text()).toBe(svg);
  await lab.reset({ map: 'posts' });
  expect((await page.request.delete(`${server.url}/api/maps/${added}`)).status()).toBe(204);
});

test('a viewer draws but does not save', async ({ lab, openLab }) => {
  const viewer = await openLab();
  await viewer.view('Draw').click();
  await drawAlong(viewer.page, [-100, 300], [0, 400]);
  await expect(check(viewer)).toContainText('1 wall.');
  await expect(viewer.button('Save and use')).toBeDisabled();
  await expect(viewer.page.getByText('You are watching')).toBeVisible();
  await expect(viewer.button('Download SVG')).toBeEnabled();
  expect(lab.scene.map).toBe('posts');
});
