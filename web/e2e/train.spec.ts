// The view Train: a policy learns a map, the user watches it, and it carries the bead.

import { readFile } from 'node:fs/promises';
import { LONG, type Lab, expect, test } from './fixtures';
import { check, drawAlong } from './support/drawing';
import {
  FEW_UPDATES,
  MORE_UPDATES,
  TRAIN_MS,
  clearTrainings,
  reachStage,
  startTraining,
} from './support/trainings';
import { must, until } from './support/wait';

test.describe.configure({ mode: 'serial', timeout: TRAIN_MS + 60_000 });

test.beforeEach(({ watch }) => {
  // A value map that is asked for while its training is removed.
  watch.allow(/404.*\/api\/trainings\//);
});

test.afterEach(async ({ page, server }) => {
  await clearTrainings(page.request, server.url);
});

const plan = (lab: Lab) => lab.page.getByRole('application', { name: /^Plan of / });
const entry = (lab: Lab, name: string) =>
  lab.page.locator('.training-entry').filter({ has: lab.page.getByText(name, { exact: true }) });
/** Of the shown training. */
const head = (lab: Lab) => lab.page.locator('.training-head');
const submit = (lab: Lab) =>
  lab.page.locator('.train-form').getByRole('button', { name: /^Train / });

async function fillIn(lab: Lab, name: string) {
  // The smallest map.
  await lab.label('Map').selectOption('u-turn');
  await lab.label('Policy name').fill(name);
  await lab.page.getByText('Settings', { exact: true }).click();
  await lab.label('Updates').fill(String(FEW_UPDATES));
}

test('trains a policy, watches it and uses it', async ({ lab, openLab, server }) => {
  const { page } = lab;
  await lab.view('Train').click();
  await fillIn(lab, 'watched');
  await submit(lab).click();
  await expect(entry(lab, 'watched')).toContainText(/takes images|learns/);
  await expect(page.locator('.train-form')).toHaveCount(0);
  await expect(head(lab)).toContainText(/learns[^]*\d+ %/, { timeout: TRAIN_MS });
  await page.locator('.train-canvas[data-update]').waitFor({ timeout: TRAIN_MS });
  await expect(page.getByTestId('train-starts')).toContainText(/^\d+ of \d+$/);
  // A cell by keyboard: its value and its fan.
  await plan(lab).focus();
  await page.keyboard.press('ArrowLeft');
  await expect(page.getByTestId('train-cell')).toContainText(
    /to the goal, value .* after \d+ updates/,
  );
  await expect(entry(lab, 'watched')).toContainText('done', { timeout: TRAIN_MS });
  await expect(entry(lab, 'watched')).toContainText(/\d+ of 1000 episodes/);
  await expect(page.getByTestId('train-examined')).toContainText(/^\d+ of 1000$/);
  await expect(page.getByText('How does it learn?')).toBeVisible();
  // The scrubber by keyboard.
  const shown = page.getByTestId('train-update');
  await expect(shown).toHaveText(`after ${FEW_UPDATES} updates`);
  await page.getByRole('slider', { name: /^Value map of/ }).focus();
  await page.keyboard.press('Home');
  await expect(shown).not.toHaveText(`after ${FEW_UPDATES} updates`);
  await page.getByRole('button', { name: /^Follow/ }).click();
  await expect(shown).toHaveText(`after ${FEW_UPDATES} updates`);
  // A viewer watches, and cannot touch anything.
  const viewer = await openLab();
  await viewer.isRole('viewer');
  await viewer.view('Train').click();
  await expect(plan(viewer)).toBeVisible();
  await expect(viewer.page.getByRole('button', { name: 'Remove watched' })).toBeDisabled();
  await viewer.button('New training').click();
  await expect(submit(viewer)).toBeDisabled();
  await viewer.page.close();
  // Its policy is in the table, with its origin.
  await page.getByText('How watched was trained').click();
  await expect(page.locator('.policies')).toContainText(`updates ${FEW_UPDATES}`);
  await head(lab).getByRole('button', { name: 'Use it: watched' }).click();
  await until('the policy', () => lab.scene.parameters.rl_policy.startsWith('watched@'));
  await until('the map', () => lab.scene.map === 'u-turn' && lab.state.controller === 'rl');
  await expect(lab.view('Lab')).toHaveAttribute('aria-current', 'page');
  await expect(lab.notice('workspace')).toContainText('RL drives with the policy watched.');
  // Its evaluation is filled in.
  await lab.view('Train').click();
  await lab.button('Evaluate watched').click();
  await expect(lab.view('Evaluate')).toHaveAttribute('aria-current', 'page');
  await expect(lab.page.getByRole('checkbox', { name: 'u-turn', exact: true })).toBeChecked();
  await expect(lab.label('Policy of RL')).toHaveValue(/^watched@/);
  await lab.view('Lab').click();
  await lab.reset({ map: 'posts' });
  await lab.restoreDefaults();
  expect((await page.request.get(`${server.url}/api/policies/watched.safetensors`)).status()).toBe(
    200,
  );
});

/** Presses the button, and waits for the end. Seconds from the press, and the share of all pairs. */
async function learnToy(lab: Lab, name: string) {
  const pressed_ms = Date.now();
  await lab.button('Watch it learn (15 s)').click();
  await expect(entry(lab, name)).toBeVisible();
  await lab.page.locator('.train-canvas[data-update]').waitFor({ timeout: TRAIN_MS });
  const first_s = (Date.now() - pressed_ms) / 1000;
  const sentence = entry(lab, name).getByText(/all pairs of cells/);
  await expect(sentence).toBeVisible({ timeout: TRAIN_MS });
  const spent_s = (Date.now() - pressed_ms) / 1000;
  const [, reached, all] = must(/\((\d+) of (\d+)\)/.exec(await sentence.innerText()), 'counts');
  const description = `${name}: ${reached} of ${all} pairs in ${spent_s} s, first values after ${first_s} s`;
  test.info().annotations.push({ type: 'toy', description });
  return { spent_s, share: Number(reached) / Number(all) };
}

test('learns the toy map while one watches', async ({ lab }) => {
  const { page } = lab;
  await lab.view('Train').click();
  // Something to see before that.
  const finished = page.getByRole('application', { name: /of a finished training$/ });
  await lab.button('Play a finished training').click();
  await expect(finished).toHaveAttribute('data-update', /^\d+$/);
  await expect(
    page.getByText('A finished training on the map toy, played again and again.'),
  ).toBeVisible();
  await lab.button('Play a finished training').click();
  await expect(finished).toHaveCount(0);
  await expect(page.getByText('It gets the name my-toy; seed 1.')).toBeVisible();
  const { share } = await learnToy(lab, 'my-toy');
  expect(share).toBeGreaterThanOrEqual(0.9);
  await expect(head(lab)).toContainText(/reaches the goal from \d+ % of all pairs of cells/);
  await head(lab).getByRole('button', { name: 'Use it: my-toy' }).click();
  await until('the map', () => lab.scene.map === 'toy' && lab.state.controller === 'rl');
  await lab.reset({ map: 'posts' });
  await lab.restoreDefaults();
});

test('learns the toy map with five seeds', LONG, async ({ lab }) => {
  await lab.view('Train').click();
  for (const name of ['my-toy', 'my-toy-2', 'my-toy-3', 'my-toy-4', 'my-toy-5']) {
    if (name !== 'my-toy') await lab.button('New training').click();
    const { share, spent_s } = await learnToy(lab, name);
    expect(share, name).toBeGreaterThanOrEqual(0.9);
    // Seconds on cores that do nothing else.
    if (process.env.FERRY_IDLE) expect(spent_s, name).toBeLessThan(20);
  }
});

test('plays a finished training while one’s own has no values yet', async ({ lab, server }) => {
  const { page } = lab;
  await startTraining(page.request, server.url, 'first', MORE_UPDATES);
  await startTraining(page.request, server.url, 'second');
  await lab.view('Train').click();
  await expect(page.getByText(/^Waits for 1 job before it.* Meanwhile: A finished/)).toBeVisible();
  await expect(plan(lab)).toHaveAccessibleName(/of a finished training$/);
});

test(
  'draws a maze, trains on it, uses the policy, and it delivers',
  LONG,
  async ({ lab, server }) => {
    const { page } = lab;
    await lab.view('Draw').click();
    // A small floor, so that the training takes a minute.
    await lab.label('Begin with').selectOption('u-turn');
    await lab.button('Mirror top and bottom').click();
    await page.getByRole('slider', { name: 'Width' }).fill('20');
    await drawAlong(page, [-110, 385], [-75, 385]);
    await expect(check(lab)).toContainText('2 walls');
    await expect(check(lab)).not.toContainText('regions');
    await lab.label('Name').fill('Drawn by hand');
    await lab.button('Save and use').click();
    await until('the map', () => lab.scene.map === 'drawn-by-hand');
    await lab.button('Train a policy on it').click();
    await expect(lab.label('Map')).toHaveValue('drawn-by-hand');
    await expect(lab.label('Policy name')).toHaveValue('my-drawn-by-hand');
    await page.getByText('Settings', { exact: true }).click();
    await lab.label('Updates').fill('2000');
    await submit(lab).click();
    const trained = entry(lab, 'my-drawn-by-hand');
    await expect(trained).toContainText('done', { timeout: TRAIN_MS });
    const reached = /(\d+) of 1000 episodes/.exec(await trained.innerText())?.[1];
    expect(Number(reached), 'episodes that reached the goal').toBeGreaterThanOrEqual(970);
    const order = Number(await page.getByTestId('train-correlation').innerText());
    // So few updates teach the steps, but not yet all values.
    expect(order, 'rank correlation').toBeGreaterThan(0.5);
    // The table of policies has such a button, too.
    await head(lab)
      .getByRole('button', { name: /^Use it/ })
      .click();
    await until('RL', () => lab.state.controller === 'rl');
    await expect(page.locator('.about-controller')).toContainText('my-drawn-by-hand');
    await lab.speed('8');
    const bead = await lab.bead();
    await lab.setGoal(must(lab.freePoints(bead, 0.1, 0.2).at(-1), 'a goal behind the wall'));
    await lab.run();
    await lab.delivered(1);
    await lab.pause();
    await lab.reset({ map: 'posts' });
    await lab.restoreDefaults();
    const map = `${server.url}/api/maps/drawn-by-hand`;
    expect((await page.request.delete(map)).status()).toBe(204);
  },
);

test('pauses, resumes, cancels and removes a training', LONG, async ({ lab, server }) => {
  const { page } = lab;
  for (const name of ['one', 'two']) {
    await startTraining(page.request, server.url, name, MORE_UPDATES);
  }
  await lab.view('Train').click();
  await expect(entry(lab, 'two')).toContainText('Waits for 1 job before it');
  await expect(entry(lab, 'one')).toContainText('learns', { timeout: TRAIN_MS });
  await entry(lab, 'one').getByRole('button', { name: /^one/ }).click();
  await lab.button('Pause one').click();
  await expect(head(lab)).toContainText(/pausing…|Paused after/);
  await expect(head(lab)).toContainText('Paused after');
  await lab.button('Resume one').click();
  await entry(lab, 'two').getByRole('button', { name: /^two/ }).click();
  await lab.button('Cancel two').click();
  await lab.button('Keep two').click();
  await lab.button('Cancel two').click();
  await lab.button('Yes, cancel two').click();
  await expect(entry(lab, 'two')).toContainText('cancelled');
  await page.getByRole('button', { name: 'Remove two' }).click();
  await expect(entry(lab, 'two')).toHaveCount(0);
  await expect(entry(lab, 'one')).toHaveCount(1);
});

test('shows two trainings side by side', LONG, async ({ lab, server }) => {
  const { page } = lab;
  for (const name of ['left', 'right']) {
    const id = await startTraining(page.request, server.url, name);
    await reachStage(page.request, server.url, id, 'done');
  }
  await lab.view('Train').click();
  await lab.button('Compare with left').click();
  await expect(page.locator('.train-pane')).toHaveCount(2);
  await lab.button('Curves').click();
  await expect(page.locator('.train-keys .key')).toHaveText(['right', 'left']);
  // The same place in both.
  await plan(lab).first().focus();
  await page.keyboard.press('ArrowLeft');
  await expect(page.getByTestId('train-cell')).toHaveCount(2);
  await lab.button('Compare with left').click();
  await expect(page.locator('.train-pane')).toHaveCount(1);
});

test('downloads, uploads, renames and deletes a policy', LONG, async ({ lab, server }) => {
  const { page } = lab;
  const id = await startTraining(page.request, server.url, 'copied');
  await reachStage(page.request, server.url, id, 'done');
  await lab.view('Train').click();
  const downloading = page.waitForEvent('download');
  await page.getByRole('link', { name: 'Download copied' }).click();
  const file = await (await downloading).path();
  await page.getByLabel('File of a policy').setInputFiles({
    name: 'Copied.safetensors',
    mimeType: 'application/octet-stream',
    buffer: await readFile(file),
  });
  const names = page.locator('.policy-name');
  await expect(names.last()).toHaveText('copied-2');
  await lab.button('Rename copied-2').click();
  await page.keyboard.type('the copy');
  await page.keyboard.press('Enter');
  await expect(page.locator('.policies .refusal')).toContainText('a to z');
  await page.keyboard.press('ControlOrMeta+a');
  await page.keyboard.type('the-copy');
  await page.keyboard.press('Enter');
  await expect(names.last()).toHaveText('the-copy');
  await lab.button('Delete the-copy').click();
  await lab.button('Yes, delete the-copy').click();
  await expect(names.last()).toHaveText('copied');
  // The one in use is asked for, and its training names no policy any more.
  await lab.button('Use it: copied').first().click();
  await until('the policy', () => lab.scene.parameters.rl_policy.startsWith('copied@'));
  await lab.view('Train').click();
  await lab.button('Delete copied').click();
  await expect(page.locator('.policies .confirm')).toContainText('The laboratory uses it. Delete?');
  await lab.button('Yes, delete copied').click();
  await expect(head(lab)).toContainText('policy deleted');
  await expect(lab.button('Use it: copied')).toHaveCount(0);
});
