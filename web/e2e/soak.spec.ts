// A long run: the page keeps its budgets, and the memory of the page and the server does not grow.
// `[SOAK_MINUTES=30] npm run soak`

import { Lab, expect, test } from './fixtures';
import { type Memory, growth, memoryOf, memoryWords, writeReport } from './support/growth';
import { Meter, type Count, figuresOf, overruns, stepThrough, summaryOf } from './support/meter';

const MINUTES = Number(process.env.SOAK_MINUTES ?? 30);
const MINUTE_MS = 60_000;
/** The history and the event log have limits. Both are filled before the measurement. */
const HISTORY_S = 620;
const LOG_LINES = 300;
const MAX_FILLING_MS = 5 * MINUTE_MS;
const STEPS = 100;
const SEED = 7;

/** Numbers from 0 to 1, which follow from the seed (mulberry32). */
function mulberry32(seed: number) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Acts as an operator: sets another goal or, one time in four, drags the bead away. */
async function act(lab: Lab, random: () => number, pause_ms: number) {
  const bead = await lab.bead();
  const near = (min_m: number, max_m: number) => {
    const points = lab.freePoints(bead, min_m, max_m);
    return points[Math.floor(random() * points.length)] ?? points[0];
  };
  if (random() < 0.25) {
    const { mouse } = lab.page;
    await mouse.move(...(await lab.px(bead)));
    await mouse.down();
    await mouse.move(...(await lab.px(near(0.04, 0.15))), { steps: 10 });
    await mouse.up();
  } else {
    await lab.click(near(0.1, 0.5));
  }
  // A plain delay: the page is left alone, and there is no condition to wait for.
  await new Promise((resolve) => setTimeout(resolve, pause_ms));
}

/** Runs at full speed until the history and the event log have reached their limits. */
async function fill(lab: Lab, random: () => number) {
  const end = Date.now() + MAX_FILLING_MS;
  await lab.speed('64');
  const lines = lab.page.getByRole('log').locator('.log-line');
  const isFull = async () => lab.state.sim_time_s > HISTORY_S && (await lines.count()) >= LOG_LINES;
  while (!(await isFull()) && Date.now() < end) await act(lab, random, 100);
  await lab.speed('1');
  console.log(`filled: ${lab.state.sim_time_s.toFixed(0)} s, ${await lines.count()} lines`);
}

test('keeps its budgets and does not grow', async ({ page, session, server }) => {
  const meter = await Meter.attach(page);
  const lab = await Lab.attach(page, session.url);
  await lab.isRole('operator');
  await lab.reset();
  await lab.run();
  const random = mulberry32(SEED);
  await fill(lab, random);
  const counts: Count[] = [];
  const samples: Memory[] = [];
  for (let minute = 1; minute <= MINUTES; minute++) {
    const end = Date.now() + MINUTE_MS;
    await meter.start();
    while (Date.now() < end) await act(lab, random, 3000 + 5000 * random());
    const count = await meter.stop();
    counts.push(count);
    const sample = {
      ...(await memoryOf(minute, meter, server)),
      ...figuresOf([count]),
    };
    samples.push(sample);
    console.log(`${memoryWords(sample)}; ${summaryOf(sample)}`);
  }
  await lab.pause();
  await meter.start();
  await stepThrough(lab, STEPS);
  const { step_to_frame_p95_ms } = figuresOf([await meter.stop()]);
  const figures = { ...figuresOf(counts), step_to_frame_p95_ms };
  const faults = [...overruns(figures), ...growth(samples)];
  await writeReport('soak', { minutes: MINUTES, seed: SEED, figures, faults, samples });
  console.log(
    `in all: ${summaryOf(figures)}, ` +
      `step to frame p95 ${step_to_frame_p95_ms?.toFixed(1) ?? '–'} ms`,
  );
  expect(faults).toEqual([]);
});
