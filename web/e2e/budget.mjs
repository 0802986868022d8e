// What the page may weigh, cost and lag. A machine that runs tests has other things to do besides:
// there the times may be LENIENCY times as long, so that a fault shows and a busy minute does not.
// `make soak` holds the page to them.

import { gzipSync } from 'node:zlib';
import { check, until } from './harness.mjs';
import { Lab } from './lab.mjs';
import { Meter, figuresOf, stepThrough } from './meter.mjs';

export const MOST = {
  page_gzip_bytes: 500_000,
  script_ms_per_frame: 4,
  state_to_frame_p95_ms: 50,
  // Bounds from above what a state takes from the session to the screen: the way of the command is
  // in it, the tick, and the camera's picture when one is due.
  step_to_frame_p95_ms: 100,
};
const LENIENCY = 3;
const RUN_MS = 8000;
const STEPS = 40;
/** What takes the processors for some seconds is not the page's fault. */
const ATTEMPTS = 3;

/** Which of `figures` are beyond their budget. */
export function overruns(figures, leniency = 1) {
  return Object.entries(MOST)
    .filter(([name, most]) => figures[name] > most * leniency)
    .map(([name, most]) => `${name} is ${figures[name].toFixed(1)}, budget ${most}`);
}

/** Opens a page that is measured. */
export async function openMeasured(browser, url) {
  const context = await browser.newContext({
    viewport: { width: 1280, height: 800 },
    colorScheme: 'dark',
  });
  const page = await context.newPage();
  const meter = await Meter.attach(page);
  return { meter, lab: await Lab.attach(page, url) };
}

/** Everything that comes before anything is opened: the document, scripts, style sheets, fonts. */
async function weighsLittle({ browser, server }) {
  const page = await browser.newPage();
  const parts = [];
  page.on('response', (response) => {
    const kind = response.request().resourceType();
    if (['document', 'script', 'stylesheet', 'font'].includes(kind)) parts.push(response);
  });
  await page.goto(server.url);
  await page.getByTestId('tick').waitFor();
  await page.waitForLoadState('load');
  let bytes = 0;
  for (const part of parts) bytes += gzipSync(await part.body()).length;
  await page.context().close();
  console.log(`      ${parts.length} files, ${(bytes / 1000).toFixed(1)} kB gzip`);
  // A development server sends the sources, each by itself.
  if (parts.some((part) => part.url().includes('/@vite/'))) return;
  check(bytes <= MOST.page_gzip_bytes, `the page weighs ${bytes} bytes`);
}

export const words = (figures) =>
  [
    `${figures.frames} frames, ${figures.frames_per_s.toFixed(1)} a second`,
    `script ${figures.script_ms_per_frame.toFixed(2)} ms a frame`,
    `all tasks ${figures.tasks_ms_per_frame.toFixed(2)} ms`,
    `state to frame p50 ${figures.state_to_frame_p50_ms?.toFixed(1)} ms`,
    `p95 ${figures.state_to_frame_p95_ms?.toFixed(1)} ms`,
  ].join(', ');

/** The figures of a page that steps, and then runs. */
async function measured(meter, lab) {
  await lab.reset();
  await stepThrough(lab, 3);
  await meter.start();
  await stepThrough(lab, STEPS);
  const stepped = figuresOf([await meter.stop()]);
  await lab.click(lab.freePoints(await lab.point('bead'), 0.25, 0.4).at(-1));
  await lab.run();
  await until('a second', () => lab.state.sim_time_s > 1);
  await meter.start();
  await lab.page.waitForTimeout(RUN_MS);
  const figures = figuresOf([await meter.stop()]);
  await lab.pause();
  console.log(`      ${words(figures)}`);
  console.log(`      step to frame p95 ${stepped.step_to_frame_p95_ms?.toFixed(1)} ms`);
  figures.step_to_frame_p95_ms = stepped.step_to_frame_p95_ms;
  check(figures.states > 20 && stepped.step_to_frame_p95_ms > 0, 'nothing was measured');
  return figures;
}

async function keepsUp({ lab: usual, browser, server }) {
  await usual.reset();
  await usual.button('Release control').click();
  await usual.button('Take control').waitFor();
  const { meter, lab } = await openMeasured(browser, server.url);
  try {
    await until('the operator', async () => (await lab.text('role')) === 'operator');
    let over;
    for (let attempt = 0; attempt < ATTEMPTS && over?.length !== 0; attempt++) {
      over = overruns(await measured(meter, lab), LENIENCY);
    }
    check(over.length === 0, `${LENIENCY} times the budget is not enough: ${over.join('; ')}`);
  } finally {
    await lab.page.context().close();
    await usual.button('Take control').click();
    await usual.button('Release control').waitFor();
  }
}

export const BUDGET = [
  ['weighs at most 500 kB before anything is opened', weighsLittle],
  ['keeps its budgets of time', keepsUp],
];
