// Experiment links and presets.

import { type Lab, expect, test } from './fixtures';
import { until } from './support/wait';

const QUESTION = /This link asks for map colon, ERRT/i;
const UNKNOWN_MAP = /map is “liver”/i;
const OUT_OF_RANGE = /friction is 7/i;
const PRESET = 'A shaken table, T = 3 cm';

const fieldOf = (lab: Lab) => lab.page.getByLabel('Link to this experiment');
const questionOf = (lab: Lab) => lab.page.getByRole('alert', { name: 'Link' });

async function sharedLink(lab: Lab) {
  await lab.button('Share').click();
  const link = await fieldOf(lab).inputValue();
  await lab.page.keyboard.press('Escape');
  await expect(fieldOf(lab)).toHaveCount(0);
  return link;
}

/** As if it had been typed after the page's address. */
async function visit(lab: Lab, hash: string) {
  await lab.page.evaluate((text) => {
    document.location.hash = text;
  }, hash);
}

/** An experiment unlike the usual one, and its link. */
async function shareOne(lab: Lab) {
  await lab.map('colon');
  await lab.controller('ERRT');
  await lab.tune('Threshold T', '8');
  await lab.tune('Fetch radius', '1.5');
  await until('both', () => lab.scene.parameters.fetch_radius_m === 0.015);
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
  return sharedLink(lab);
}

const isColon = (lab: Lab) => () => lab.scene.map === 'colon' && lab.state.goal_m;

test('copies the link of an experiment', async ({ lab }) => {
  const link = await shareOne(lab);
  for (const part of ['map=colon', 'controller=errt', 'threshold_m=0.08', 'fetch_radius_m=0.015']) {
    expect(link).toContain(part);
  }
  await lab.button('Share').click();
  await lab.button('Copy').click();
  await expect(lab.page.locator('.share-done')).toHaveText(/\S/);
});

test('asks a viewer before it loads an experiment', async ({ lab, openLab }) => {
  const link = await shareOne(lab);
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
  await question.getByRole('button', { name: 'Load' }).click();
  await until('the colon', isColon(second));
  expect({
    seed: second.scene.seed,
    controller: second.state.controller,
    threshold_m: second.scene.parameters.threshold_m,
    start: await second.point('bead'),
    link: await sharedLink(second),
  }).toEqual({ seed, controller: 'errt', threshold_m: 0.08, start, link });
  await expect(question).toHaveText('');

  // It is a question once: control given and taken, another map; the address stays as it is.
  await second.reset({ map: 'open' });
  await second.releaseControl();
  await lab.takeControl();
  expect(second.scene.map, 'it was loaded again').toBe('open');
});

test('loads the experiment of its address at once for an operator', async ({ lab }) => {
  const link = await shareOne(lab);
  await lab.restoreDefaults();
  await lab.reset({ map: 'posts' });
  await visit(lab, new URL(link).hash);
  await until('the colon', isColon(lab));
  // And when opened.
  await lab.restoreDefaults();
  await lab.reset({ map: 'posts' });
  await lab.page.reload();
  await until('the colon again', isColon(lab));
  await lab.live();
});

test('refuses a broken link', async ({ lab }) => {
  const before = await sharedLink(lab);
  const question = questionOf(lab);
  await visit(lab, '#v=1&map=liver&controller=errt&seed=1');
  await expect(question).toContainText(UNKNOWN_MAP);
  await question.getByRole('button', { name: 'Dismiss the link' }).click();
  await expect(question).toHaveText('');

  // What only the server can check.
  await visit(lab, '#v=1&map=posts&controller=errt&seed=1&friction=7');
  await expect(lab.notice('controller').getByText(OUT_OF_RANGE)).toBeVisible();
  expect(await sharedLink(lab), 'something was loaded').toBe(before);
});

test('loads a preset', async ({ lab }) => {
  const shown = lab.label('Preset').locator('option:checked');
  await expect(shown).toHaveText('Preset…');
  await lab.label('Preset').selectOption(PRESET);
  await until('it', () => lab.scene.map === 'open' && lab.scene.parameters.threshold_m === 0.03);
  expect(lab.scene.scenario.script.length, 'kicks').toBe(4);
  await expect(shown).toHaveText(PRESET);
  await lab.restoreDefaults();
  await expect(shown).toHaveText('Preset…');
});
