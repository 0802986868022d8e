// Experiment links that are opened and presets.

import { Lab, expect, test } from './fixtures';
import { skipFirstVisit } from './support/lab';
import { until } from './support/wait';

const QUESTION = /This link asks for map colon, ERRT/i;
const PRESET = 'A shaken table, T = 3 cm';

const fieldOf = (lab: Lab) => lab.page.getByLabel('Link: A copy for each');
const questionOf = (lab: Lab) => lab.page.getByRole('alert', { name: 'Link' });

/** The shared experiment at the address of this session. */
async function sharedLink(lab: Lab) {
  // The link is of the experiment that the page shows.
  await lab.drawn();
  await lab.button('Share').click();
  const { hash } = new URL(await fieldOf(lab).inputValue());
  await lab.page.keyboard.press('Escape');
  await expect(fieldOf(lab)).toHaveCount(0);
  return new URL(hash, lab.page.url()).href;
}

/** Changes the part of the address after `#`, as if it was typed. */
async function setHash(lab: Lab, hash: string) {
  await lab.page.evaluate((text) => {
    document.location.hash = text;
  }, hash);
}

/** Changes the experiment and returns its link. */
async function shareChanged(lab: Lab) {
  await lab.map('colon');
  await lab.controller('ERRT');
  await lab.tune('Threshold T', '8');
  await lab.tune('Fetch radius', '1.5');
  await until('both parameters', () => lab.scene.parameters.fetch_radius_m === 0.015);
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
  return sharedLink(lab);
}

const isColon = (lab: Lab) => () => lab.scene.map === 'colon' && lab.state.goal_m;

test('asks a viewer before it loads a linked experiment', async ({ lab, openLab }) => {
  const link = await shareChanged(lab);
  const { seed } = lab.scene;
  const start = await lab.bead();
  await lab.restoreDefaults();
  await lab.reset({ map: 'posts' });

  // When control is free, Load takes it.
  const second = await openLab({ url: link });
  const question = questionOf(second);
  await expect(question).toContainText(QUESTION);
  expect(second.scene.map, 'a viewer loaded it').toBe('posts');
  await lab.releaseControl();
  await question.getByRole('button', { name: 'Load it here' }).click();
  await until('the map colon', isColon(second));
  expect({
    seed: second.scene.seed,
    controller: second.state.controller,
    threshold_m: second.scene.parameters.threshold_m,
    start: await second.bead(),
    link: await sharedLink(second),
  }).toEqual({ seed, controller: 'errt', threshold_m: 0.08, start, link });
  await expect(question).toHaveText('');

  // The page asks only once: neither another map nor a change of control loads it again.
  await second.reset({ map: 'open' });
  await second.releaseControl();
  await lab.takeControl();
  expect(second.scene.map, 'it was loaded again').toBe('open');
});

test('loads a linked experiment at once for the operator', async ({ lab }) => {
  const link = await shareChanged(lab);
  await lab.restoreDefaults();
  await lab.reset({ map: 'posts' });
  await setHash(lab, new URL(link).hash);
  await until('the map colon', isColon(lab));
  // It has left the address: a reload goes on with what came after.
  await expect.poll(() => new URL(lab.page.url()).hash).toBe('');
  await lab.restoreDefaults();
  await lab.reset({ map: 'posts' });
  const { trial } = lab.scene;
  await lab.page.reload();
  await lab.live();
  expect(lab.scene.trial, 'it was loaded again').toBe(trial);
  // The page also loads it when it opens.
  await lab.page.goto(new URL('/healthz', link).href);
  await lab.page.goto(link);
  await until('the map colon again', isColon(lab));
  await lab.live();
});

test('loads a preset', async ({ lab }) => {
  await lab.setUp();
  const selected = lab.label('Preset').locator('option:checked');
  await expect(selected).toHaveText('Preset…');
  await lab.label('Preset').selectOption(PRESET);
  await until(
    'the preset',
    () => lab.scene.map === 'open' && lab.scene.parameters.threshold_m === 0.03,
  );
  expect(lab.scene.scenario.script.length, 'kicks').toBe(4);
  await expect(selected).toHaveText(PRESET);
  await lab.setUp();
  await lab.restoreDefaults();
  await lab.setUp();
  await expect(selected).toHaveText('Preset…');
});

test('a shared copy opens in a session of its own, after one press', async ({
  lab,
  browser,
  server,
}) => {
  await shareChanged(lab);
  const { trial } = lab.scene;
  await lab.button('Share').click();
  const copy = await fieldOf(lab).inputValue();
  const context = await browser.newContext();
  const page = await context.newPage();
  await skipFirstVisit(page);
  const other = new Lab(page);
  await page.goto(copy);
  await page.getByRole('button', { name: 'Open it' }).click();
  await other.live();
  await other.isRole('operator');
  await until('the map colon', isColon(other));
  expect(other.hello.session).toMatch(/^[a-z]+-[a-z]+-[a-z0-9]+$/);
  expect([lab.scene.trial, lab.hello.role]).toEqual([trial, 'operator']);
  await context.close();
  await fetch(`${server.url}/api/sessions/${other.hello.session}`, { method: 'DELETE' });
});
