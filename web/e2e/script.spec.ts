// Script: disturbances are added, applied at their time, shown on the timeline and removed.

import { expect, test } from './fixtures';
import { distance } from './support/table';
import { must, until } from './support/wait';

const X_LABEL = 'x of the new place in metres';
const Y_LABEL = 'y of the new place in metres';

test('adds, applies, shows and removes a disturbance of the script', async ({ lab }) => {
  const { page } = lab;
  const { seed } = lab.scene;
  const start = await lab.bead();
  const away = must(lab.freePoints(start, 0.15, 0.3).at(-1), 'a place');
  const goal_m = await lab.setGoal(lab.freePoints(start, 0.3, 0.45)[0]);

  await lab.button('Disturb').click();
  await page.getByLabel('Kind of disturbance').selectOption('Move');
  await page.getByLabel('When the disturbance happens').selectOption('at a time');
  await page.getByLabel('Time in seconds').fill('2');
  // The next click on the plan view picks the place and sets no goal.
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
  const entry = page.getByRole('table', { name: 'Script' }).getByRole('row').last();
  await expect(entry).toHaveText(/^at 2\.0 s\s*move to/);

  await lab.stepUntil('the move', () => lab.state.disturbances === 1, 25);
  await lab.button('Add random moves…').click();
  const random = page.getByLabel('Number of random moves');
  await random.fill('3');
  // Before the move, its mark is hollow and ahead.
  const track = await lab.boxOf(page.getByLabel('Timeline'));
  await page.mouse.click(track.x + 0.2 * track.width, track.y + track.height / 2);
  await until('a tick before the move', () => lab.state.tick < 200 && lab.state.disturbances === 0);
  await expect(page.locator('.script-marks circle')).toHaveCount(1);

  await lab.drawn();
  await expect(random, 'the rewind set the field').toHaveValue('3');
  await lab.button('Set and restart').click();
  await until('three random moves', () => lab.scene.scenario.disturbances === 3);
  expect(lab.scene.scenario.script.length).toBe(1);
  await page.getByRole('button', { name: /^Remove and restart/ }).click();
  await until('no script', () => lab.scene.scenario.script.length === 0);
  // The restart sets the field again.
  await lab.drawn();
  await random.fill('0');
  await random.press('Enter');
  await until('no random moves', () => lab.scene.scenario.disturbances === 0);
  await lab.drawn();

  // A move at once, by keyboard only: the field accepts signs and points key by key.
  await page.getByLabel('When the disturbance happens').selectOption('now');
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
  await until('the bead at its new place', async () => distance(await lab.bead(), away) < 0.01);

  // The restart made the goal part of the scenario. Another map has no goal.
  await lab.reset({ map: 'colon' });
  await lab.reset();
  expect(lab.state.goal_m, 'the goal was kept').toBeNull();
});
