// Disturbances by script: added, struck, shown in time, removed.

import { expect, test } from './fixtures';
import { distance } from './support/table';
import { must, until } from './support/wait';

const X_LABEL = 'x of the new place in metres';
const Y_LABEL = 'y of the new place in metres';

test('disturbs by script', async ({ lab }) => {
  const { page } = lab;
  const { seed } = lab.scene;
  const start = await lab.bead();
  const away = must(lab.freePoints(start, 0.15, 0.3).at(-1), 'a place');
  const goal_m = await lab.setGoal(lab.freePoints(start, 0.3, 0.45)[0]);

  await lab.button('Disturb').click();
  await page.getByLabel('Kind of disturbance').selectOption('Move');
  await page.getByLabel('Time of the disturbance').selectOption('at a time');
  await page.getByLabel('Time in seconds').fill('2');
  // The next click on the plan view is the place, and no goal.
  await lab.button('Pick the new place on the map').click();
  await lab.click(away);
  const x = page.getByLabel(X_LABEL);
  await until('the place', async () => Math.abs(Number(await x.inputValue()) - away[0]) < 0.003);
  expect(lab.state.goal_m, 'picking moved the goal').toEqual(goal_m);
  const { trial } = lab.scene;
  await lab.button('Add to script and restart').click();
  await until('a new trial', () => lab.scene.trial > trial && lab.state.tick === 0);
  expect(lab.scene.seed).toBe(seed);
  expect(distance(must(lab.state.goal_m, 'the goal'), goal_m)).toBeLessThan(1e-6);
  expect(distance(await lab.bead(), start), 'the start changed').toBeLessThan(1e-6);
  const entry = page.getByRole('list', { name: 'Script' }).getByRole('listitem');
  await expect(entry).toHaveText(/^at 2\.0 s: move to/);

  // So slow that a pause comes soon after the move, by the length of the timeline.
  await lab.speed('2');
  await lab.run();
  await until('the move', () => lab.state.disturbances === 1);
  await lab.pause();
  // Back before it: the hollow mark lies ahead.
  const track = await lab.boxOf(page.getByLabel('Timeline'));
  await page.mouse.click(track.x + 0.2 * track.width, track.y + track.height / 2);
  await until('before it', () => lab.state.tick < 200 && lab.state.disturbances === 0);
  await expect(page.locator('.script-marks circle')).toHaveCount(1);

  const random = page.getByLabel('Number of random moves');
  await random.fill('3');
  await lab.button('Set and restart').click();
  await until('random ones', () => lab.scene.scenario.disturbances === 3);
  expect(lab.scene.scenario.script.length).toBe(1);
  await page.getByRole('button', { name: /^Remove and restart/ }).click();
  await until('no script', () => lab.scene.scenario.script.length === 0);
  // The restart sets the field once more.
  await lab.drawn();
  await random.fill('0');
  await page.keyboard.press('Enter');
  await until('none at random', () => lab.scene.scenario.disturbances === 0);
  await lab.drawn();

  // Now, by keyboard alone: key by key, with signs and points.
  await page.getByLabel('Time of the disturbance').selectOption('now');
  for (const [label, value] of [
    [X_LABEL, away[0]],
    [Y_LABEL, away[1]],
  ] as const) {
    const field = page.getByLabel(label);
    await field.focus();
    await page.keyboard.press('ControlOrMeta+a');
    await page.keyboard.type(value.toFixed(3));
    await expect(field).toHaveValue(value.toFixed(3));
  }
  await x.press('Enter');
  await until('moved now', async () => distance(await lab.bead(), away) < 0.01);

  // A restart has made the goal part of the scenario; another map has none.
  await lab.reset({ map: 'colon' });
  await lab.reset();
  expect(lab.state.goal_m, 'the goal stays').toBeNull();
});
