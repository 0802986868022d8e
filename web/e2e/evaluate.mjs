// The paper's experiment on the page: asked for by keyboard, watched, cancelled, and a failure set up again.

import { check, until } from './harness.mjs';
import { Lab, distance } from './lab.mjs';

const LONG = 1000;
const RUN_MS = 120_000;

async function goTo(lab, view) {
  await lab.page
    .getByRole('navigation', { name: 'Views' })
    .getByRole('button', { name: view })
    .click();
}

/** Presses Tab until the control has the focus. */
async function tabTo(page, control) {
  for (let i = 0; i < 60; i++) {
    if (await control.evaluate((one) => one === document.activeElement)) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`the keyboard does not reach ${control}`);
}

/** The form, filled in by keyboard alone. */
async function fillIn(page, { controllers, maps, disturbances, episodes, seed }) {
  const form = page.getByRole('region', { name: 'New evaluation' });
  const boxes = { Controllers: controllers, Maps: maps, 'Disturbances an episode': disturbances };
  await page.getByRole('button', { name: 'Evaluate', exact: true }).focus();
  for (const [legend, wanted] of Object.entries(boxes)) {
    for (const box of await form.getByRole('group', { name: legend }).getByRole('checkbox').all()) {
      const name = await box.evaluate((one) => one.labels[0].textContent.trim());
      if ((await box.isChecked()) === wanted.includes(name)) continue;
      await tabTo(page, box);
      await page.keyboard.press('Space');
      check((await box.isChecked()) === wanted.includes(name), `Space does not choose ${name}`);
    }
  }
  for (const [label, value] of [
    ['Episodes a cell', episodes],
    ['Seed', seed],
  ]) {
    await tabTo(page, form.getByLabel(label, { exact: true }));
    await page.keyboard.press('ControlOrMeta+a');
    await page.keyboard.type(String(value));
  }
  return form;
}

async function ask(lab, path) {
  return lab.page.evaluate(async (address) => (await fetch(address)).json(), path);
}

const stage = (lab) => lab.text('evaluation-stage');

/** The evaluation that the page shows, as the server tells it. */
async function shownReport(lab) {
  const number = /\d+/.exec(
    await lab.page.getByRole('heading', { name: /^Evaluation \d+/ }).textContent(),
  )[0];
  return ask(lab, `/api/evaluations/evaluation-${number}`);
}

export async function evaluates({ lab, watch }) {
  const { page } = lab;
  await goTo(lab, 'Evaluate');
  const wanted = {
    controllers: ['ERRT', 'Attractor'],
    maps: ['posts'],
    disturbances: ['0'],
    seed: 1,
  };

  // What is refused is said at its field, and nothing begins.
  const form = await fillIn(page, { ...wanted, episodes: 0 });
  await page.keyboard.press('Enter');
  const episodes = form.getByLabel('Episodes a cell', { exact: true });
  await until('a refusal', async () => (await episodes.getAttribute('aria-invalid')) === 'true');
  const described = await episodes.getAttribute('aria-describedby');
  const words = await page.locator(`[id="${described}"]`).innerText();
  check(words.includes('episodes is 0') && words.includes('1 to 1000'), `it says ${words}`);
  await lab.screenshot('evaluate-refused');
  // The browser itself remarks on a refusal; this one was asked for.
  watch.complaints = watch.complaints.filter((text) => !text.includes('422'));
  const before = (await ask(lab, '/api/evaluations')).evaluations.length;

  await fillIn(page, { ...wanted, episodes: 4 });
  check((await lab.text('evaluation-scope')).startsWith('2 cells, 8 episodes'), 'another size');
  await tabTo(page, form.getByRole('button', { name: 'Run', exact: true }));
  await page.keyboard.press('Enter');
  const bar = page.getByRole('progressbar', { name: 'Progress' });
  await until('some progress', async () => (await bar.getAttribute('value')) > 0, RUN_MS);
  check((await bar.getAttribute('max')) === '8', 'the bar ends elsewhere');
  await until('the end', async () => (await stage(lab)) === 'done', RUN_MS);
  const said = await lab.text('evaluation-said');
  check(said.includes('2 of 2 rows'), `said at the end: ${said}`);

  const report = await shownReport(lab);
  check((await ask(lab, '/api/evaluations')).evaluations.length === before + 1, 'not one more');
  check(report.rows.length === 2 && report.query.episodes === 4, 'the server tells another story');
  const lines = page.getByTestId('evaluation-row');
  await until('both rows', async () => !(await lines.allTextContents()).join().includes('so far'));
  const names = { errt: 'ERRT', attractor: 'Attractor' };
  for (const [index, row] of report.rows.entries()) {
    const texts = await lines.nth(index).locator('th, td').allTextContents();
    const percent = ([low, high]) => `${(100 * low).toFixed(0)}–${(100 * high).toFixed(0)} %`;
    const cm = (value_m) => (100 * value_m).toFixed(1);
    const expected = [
      names[row.controller],
      row.map,
      String(row.disturbances),
      `${row.successes}/${row.episodes}${percent(row.successes_wilson95)}`,
      `${row.delivered}/${row.episodes}${percent(row.wilson95)}`,
      cm(row.tracking_error_mean_m),
      cm(row.tracking_error_max_x_m),
      cm(row.tracking_error_max_y_m),
      row.path_ratio_mean.toFixed(3),
      row.steps_mean.toFixed(1),
      row.switches_mean.toFixed(2),
      `${row.decision_ms_p50.toFixed(1)} · ${row.decision_ms_p99.toFixed(1)}`,
    ];
    check(
      texts.join('|') === expected.join('|'),
      `${texts.join('|')} is not ${expected.join('|')}`,
    );
  }

  const [file] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('link', { name: 'JSON' }).click(),
  ]);
  const chunks = [];
  for await (const chunk of await file.createReadStream()) chunks.push(chunk);
  const downloaded = JSON.parse(chunks.join(''));
  check(JSON.stringify(downloaded.rows) === JSON.stringify(report.rows), 'the file has other rows');
  check((await page.getByTestId('comparison').count()) === 1, 'no paired difference');
  const difference = await page.getByTestId('comparison').innerText();
  check(difference.includes('ERRT − Attractor'), `the difference says: ${difference}`);
}

export async function cancelsAnEvaluation({ lab, browser, server }) {
  const { page } = lab;
  await goTo(lab, 'Evaluate');
  const form = await fillIn(page, {
    controllers: ['RL', 'ERRT'],
    maps: ['colon'],
    disturbances: ['0', '3'],
    episodes: LONG,
    seed: 2,
  });
  await form.getByRole('button', { name: 'Run', exact: true }).press('Enter');
  const progress = /^[1-9]\d* of 4000 episodes, about .* left$/;
  await until(
    'a first episode and an estimate',
    async () => progress.test(await lab.text('evaluation-progress')),
    RUN_MS,
  );
  check((await stage(lab)) === 'runs', 'it has ended');
  await lab.screenshot('evaluate-dark');

  // A viewer watches, also one whose page is new.
  const viewer = await Lab.open(browser, server.url, { colorScheme: 'light' });
  await goTo(viewer, 'Evaluate');
  await until('the same', async () => progress.test(await viewer.text('evaluation-progress')));
  for (const name of ['Run', 'Cancel']) {
    check(await viewer.button(name).isDisabled(), `a viewer may ${name}`);
  }
  await viewer.screenshot('evaluate-light');
  await viewer.page.close();

  await lab.button('Cancel').press('Enter');
  await until('the end', async () => (await stage(lab)) === 'cancelled');
  const report = await shownReport(lab);
  check(report.stage === 'cancelled' && report.rows.length === 0, 'the server goes on');
  check((await lab.button('Cancel').count()) === 0, 'what has ended may be cancelled');
  const rows = await page.getByTestId('evaluation-row').allTextContents();
  check(rows[0].includes('broken off') && rows[3].includes('not begun'), `it says ${rows.join()}`);
}

export async function setsAFailureUpAgain({ lab }) {
  const { page } = lab;
  await goTo(lab, 'Evaluate');
  const form = await fillIn(page, {
    controllers: ['Attractor'],
    maps: ['colon'],
    disturbances: ['0'],
    episodes: 4,
    seed: 2,
  });
  await form.getByRole('button', { name: 'Run', exact: true }).press('Enter');
  await until('a new one', async () => (await lab.text('evaluation-progress')).includes('of 4 '));
  await until('the end', async () => (await stage(lab)) === 'done', RUN_MS);
  const { failures, cells } = await shownReport(lab);
  const again = page.getByRole('button', { name: /^Set it up: episode/ });
  await until('its failures', async () => (await again.count()) === failures.length);
  check(failures.length > 0, 'the attractor carries through the colon');
  await lab.screenshot('evaluate-failures');

  const last = failures.at(-1);
  await again.last().press('Enter');
  await until('the laboratory', () => lab.canvas.isVisible());
  // The server reads decimals to within a bit.
  const near = (a, b) => a && distance(a, b) < 1e-12;
  const { scenario } = await until(
    'that episode',
    () => near(lab.scene.scenario.goal_m, last.goal_m) && lab.scene,
  );
  check(near(scenario.start_m, last.start_m), 'it starts elsewhere');
  check(scenario.map === 'colon' && scenario.controller === 'attractor', 'another cell');
  check(scenario.disturbances === cells[last.cell].disturbances, 'disturbed otherwise');
  await page.getByLabel('Map', { exact: true }).selectOption('posts');
  await until('the map posts', () => lab.scene.map === 'posts');
}
