// The view Evaluate: form by keyboard, progress, results, cancelling, setting up a failed episode.

import type { Locator, Page } from '@playwright/test';
import { LONG, type Lab, expect, test } from './fixtures';
import { startEvaluation } from './support/evaluations';
import { distance } from './support/table';
import { must, until } from './support/wait';
import type { EvaluationReport, Evaluations } from './support/wire';

const MANY_EPISODES = 1000;
const RUN_MS = 90_000;
const PROGRESS = /^[1-9]\d* of 4000 episodes, about .* left$/i;
const ALL_ROWS = /2 of 2 rows/i;
const STOPPED = /stopped/i;
const NOT_STARTED = /not started/i;
const NAMES: Record<string, string> = { errt: 'ERRT', attractor: 'Attractor' };

interface FormValues {
  readonly controllers: readonly string[];
  readonly maps: readonly string[];
  readonly disturbances: readonly string[];
  readonly episodes: number;
  readonly seed: number;
}

/** Presses Tab until the control has the focus. */
async function tabTo(page: Page, control: Locator) {
  for (let i = 0; i < 60; i++) {
    if (await control.evaluate((one) => one === document.activeElement)) return;
    await page.keyboard.press('Tab');
  }
  throw new Error('Tab does not reach a control');
}

/** Fills in the form by keyboard only. */
async function fillIn(page: Page, values: FormValues) {
  const form = page.getByRole('complementary', { name: 'New evaluation' });
  // The view is loaded when it opens.
  await expect(form.getByRole('checkbox', { name: 'posts', exact: true })).toBeVisible();
  await page.getByRole('link', { name: 'Evaluate', exact: true }).focus();
  for (const [legend, wanted] of [
    ['Controllers', values.controllers],
    ['Maps', values.maps],
    ['Disturbances per episode', values.disturbances],
  ] as const) {
    for (const box of await form.getByRole('group', { name: legend }).getByRole('checkbox').all()) {
      const name = await box.evaluate((one: HTMLInputElement) => one.labels?.[0]?.textContent);
      const isWanted = wanted.includes(must(name, 'a label').trim());
      if ((await box.isChecked()) === isWanted) continue;
      await tabTo(page, box);
      await page.keyboard.press('Space');
      await expect(box).toBeChecked({ checked: isWanted });
    }
  }
  for (const [label, value] of [
    ['Episodes per cell', values.episodes],
    ['Seed', values.seed],
  ] as const) {
    await tabTo(page, form.getByLabel(label, { exact: true }));
    await page.keyboard.press('ControlOrMeta+a');
    await page.keyboard.type(String(value));
  }
  return form;
}

async function get<T>({ page }: Lab, path: string) {
  return (await (await page.request.get(new URL(path, page.url()).href)).json()) as T;
}

const count = async (lab: Lab) =>
  (await get<Evaluations>(lab, '/api/evaluations')).evaluations.length;

const stageOf = (lab: Lab) => lab.page.getByTestId('evaluation-stage');
const rowsOf = (lab: Lab) => lab.page.getByTestId('evaluation-row');

/** Reads the report of the shown evaluation from the server. */
async function shownReport(lab: Lab) {
  const heading = lab.page.getByRole('heading', { name: /^Evaluation \d+/ });
  const number = must(/\d+/.exec(await heading.innerText()), 'a number')[0];
  return get<EvaluationReport>(lab, `/api/evaluations/evaluation-${number}`);
}

/** The cells that the page must show for a row of the report. */
function cellsOf(row: EvaluationReport['rows'][number]) {
  const percent = ([low, high]: readonly [number, number]) =>
    `${(100 * low).toFixed(0)}–${(100 * high).toFixed(0)} %`;
  const cm = (value_m: number) => (100 * value_m).toFixed(1);
  return [
    `${NAMES[row.controller]}${row.map}`,
    String(row.disturbances),
    `${row.successes}/${row.episodes}${percent(row.successes_wilson95)}`,
    `${row.delivered}/${row.episodes}${percent(row.wilson95)}`,
    `${cm(row.tracking_error_mean_m)}${cm(row.tracking_error_max_x_m)} · ${cm(row.tracking_error_max_y_m)}`,
    must(row.path_ratio_mean, 'a path').toFixed(3),
    `${row.steps_mean.toFixed(1)}${row.switches_mean.toFixed(2)}`,
    `${row.decision_ms_p50.toFixed(1)}${row.decision_ms_p99.toFixed(1)}`,
  ];
}

const SMALL: FormValues = {
  controllers: ['ERRT', 'Attractor'],
  maps: ['posts'],
  disturbances: ['0'],
  episodes: 4,
  seed: 1,
};

test('runs an evaluation that is filled in by keyboard', async ({ lab }) => {
  const { page } = lab;
  await lab.view('Evaluate').click();
  const before = await count(lab);
  const form = await fillIn(page, SMALL);
  await expect(page.getByTestId('evaluation-scope')).toHaveText(/^2 cells, 8 episodes/);
  await tabTo(page, form.getByRole('button', { name: 'Run', exact: true }));
  await page.keyboard.press('Enter');
  const bar = page.getByRole('progressbar', { name: 'Progress' });
  await expect(bar).toHaveAttribute('value', /[1-9]/, { timeout: RUN_MS });
  await expect(bar).toHaveAttribute('max', '8');
  await expect(stageOf(lab)).toHaveText('done', { timeout: RUN_MS });
  await expect(page.getByTestId('evaluation-said')).toContainText(ALL_ROWS);

  const report = await shownReport(lab);
  expect(await count(lab)).toBe(before + 1);
  expect(report.rows.length).toBe(2);
  expect(report.query.episodes).toBe(4);
  for (const [index, row] of report.rows.entries()) {
    await expect
      .poll(() => rowsOf(lab).nth(index).locator('th, td').allTextContents())
      .toEqual(cellsOf(row));
  }

  const [file] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('link', { name: 'JSON' }).click(),
  ]);
  const chunks: string[] = [];
  for await (const chunk of await file.createReadStream()) chunks.push(String(chunk));
  const downloaded = JSON.parse(chunks.join('')) as EvaluationReport;
  expect(downloaded.rows).toEqual(report.rows);
  await expect(page.getByTestId('comparison')).toHaveCount(1);
  await expect(page.getByTestId('comparison')).toContainText('ERRT − Attractor');
});

test('cancels an evaluation that a viewer watches', LONG, async ({ lab, openLab }) => {
  await lab.view('Evaluate').click();
  const form = await fillIn(lab.page, {
    controllers: ['RL', 'ERRT'],
    maps: ['colon'],
    disturbances: ['0', '3'],
    episodes: MANY_EPISODES,
    seed: 2,
  });
  await form.getByRole('button', { name: 'Run', exact: true }).press('Enter');
  const progress = (where: Lab) => where.page.getByTestId('evaluation-progress');
  // Waits for a first episode and an estimate of the time left.
  await expect(progress(lab)).toHaveText(PROGRESS, { timeout: RUN_MS });
  await expect(stageOf(lab)).toHaveText('runs');

  // A viewer that opens the page later also sees the progress.
  const viewer = await openLab({ colorScheme: 'light' });
  await viewer.view('Evaluate').click();
  await expect(progress(viewer)).toHaveText(PROGRESS);
  for (const name of ['Run', 'Cancel']) await expect(viewer.button(name)).toBeDisabled();
  await viewer.page.close();

  await lab.button('Cancel').press('Enter');
  await expect(stageOf(lab)).toHaveText('cancelled');
  const report = await shownReport(lab);
  expect(report.stage).toBe('cancelled');
  expect(report.rows).toEqual([]);
  await expect(lab.button('Cancel')).toHaveCount(0);
  await expect(rowsOf(lab).nth(0)).toContainText(STOPPED);
  await expect(rowsOf(lab).nth(3)).toContainText(NOT_STARTED);
});

test('sets up a failed episode again', LONG, async ({ lab }) => {
  const { page } = lab;
  await lab.view('Evaluate').click();
  const form = await fillIn(page, {
    controllers: ['Attractor'],
    maps: ['colon'],
    disturbances: ['0'],
    episodes: 3,
    seed: 2,
  });
  await form.getByRole('button', { name: 'Run', exact: true }).press('Enter');
  await expect(page.getByTestId('evaluation-progress')).toContainText('of 3 ');
  await expect(stageOf(lab)).toHaveText('done', { timeout: RUN_MS });
  const { failures, cells } = await shownReport(lab);
  const last = must(failures.at(-1), 'a failure');
  const again = page.getByRole('button', { name: /^Set it up: episode/ });
  await expect(again).toHaveCount(failures.length);
  await again.last().press('Enter');
  await expect(lab.canvas).toBeVisible();
  // The server reads decimals to within one bit.
  const isNear = (a: [number, number] | null, b: [number, number] | null) =>
    a !== null && b !== null && distance(a, b) < 1e-12;
  await until('that episode', () => isNear(lab.scene.scenario.goal_m, last.goal_m));
  const { scenario } = lab.scene;
  expect(isNear(scenario.start_m, last.start_m), 'the start differs').toBe(true);
  expect({ ...cells[last.cell] }).toMatchObject({
    map: scenario.map,
    controller: scenario.controller,
    disturbances: scenario.disturbances,
  });
});

test('ignores a late answer for an evaluation that is no longer chosen', LONG, async ({ lab }) => {
  const { page } = lab;
  const { origin } = new URL(page.url());
  const query = {
    controllers: ['attractor' as const],
    maps: ['open'],
    disturbances: [0],
    episodes: 1,
  };
  const older = await startEvaluation(page.request, origin, { ...query, seed: 1 });
  const newer = await startEvaluation(page.request, origin, { ...query, seed: 2 });
  const choose = (id: string) =>
    page
      .getByRole('button', {
        name: new RegExp(`^${id.replace('evaluation-', '')} .*per cell, seed`),
      })
      .click();
  let answer = (): void => undefined;
  const mayAnswer = new Promise<void>((done) => (answer = done));
  await page.route(`**/api/evaluations/${older}`, async (route) => {
    await mayAnswer;
    await route.continue();
  });
  await lab.view('Evaluate').click();
  const link = page.getByRole('link', { name: 'HTML' });
  await choose(newer);
  await expect(link).toHaveAttribute('href', `/api/evaluations/${newer}/report.html`);

  const requested = page.waitForRequest(`**/api/evaluations/${older}`);
  await choose(older);
  const late = (await requested).response();
  await choose(newer);
  await expect(link).toBeVisible();
  const shown = must(await link.elementHandle(), 'the link');
  answer();
  await must(await late, 'the late answer').finished();
  await lab.drawn();
  expect(await shown.evaluate((one) => one.isConnected), 'the same link').toBe(true);
});
