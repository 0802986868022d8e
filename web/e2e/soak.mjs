// A page left open while a session runs: its budgets, and whether it or its server grows.
// FERRY_BIN=…/ferry [SOAK_MINUTES=30] node e2e/soak.mjs

import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { overruns, openMeasured, words } from './budget.mjs';
import { Watch, startBrowser, startServer, until } from './harness.mjs';
import { OUTPUT } from './lab.mjs';
import { figuresOf, stepThrough } from './meter.mjs';

const MINUTES = Number(process.env.SOAK_MINUTES ?? 30);
const MINUTE_MS = 60_000;
/** What is kept has an end: the log's lines, the moments to go back to. First, all of it is filled. */
const KEPT_S = 620;
const KEPT_LINES = 300;
const MOST_FILLING_MS = 5 * MINUTE_MS;
const SETTLED_MINUTES = Math.max(1, Math.min(5, Math.floor(MINUTES / 2)));
const COMPARED_MINUTES = 5;
const MOST_GROWTH = 0.1;
const STEPS = 100;
const SEED = 7;
const GROWS = ['heap_bytes', 'dom_nodes', 'listeners', 'server_rss_bytes'];

/** Numbers from 0 to 1, the same ones each time (mulberry32). */
function random(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

async function rssBytes(pid) {
  if (!pid) return undefined;
  const status = await readFile(`/proc/${pid}/status`, 'utf8');
  return 1024 * Number(/VmRSS:\s+(\d+)/.exec(status)[1]);
}

/** What a person does: another goal, now and then the bead taken away. */
async function play(lab, chance, pause_ms) {
  const bead = await lab.point('bead');
  const near = (least, most) => {
    const points = lab.freePoints(bead, least, most);
    return points[Math.floor(chance() * points.length)];
  };
  if (chance() < 0.25) {
    const { mouse } = lab.page;
    await mouse.move(...(await lab.px(bead)));
    await mouse.down();
    await mouse.move(...(await lab.px(near(0.04, 0.15))), { steps: 10 });
    await mouse.up();
  } else {
    await lab.click(near(0.1, 0.5));
  }
  await lab.page.waitForTimeout(pause_ms);
}

/** As fast as it goes, until nothing more is kept than before. */
async function fill(lab, chance) {
  const speed = lab.page.getByLabel('Speed', { exact: true });
  const end = Date.now() + MOST_FILLING_MS;
  await speed.selectOption('64');
  const lines = lab.page.getByRole('log').locator('.log-line');
  const isFull = async () => lab.state.sim_time_s > KEPT_S && (await lines.count()) >= KEPT_LINES;
  while (!(await isFull()) && Date.now() < end) await play(lab, chance, 100);
  await speed.selectOption('1');
  console.log(`filled: ${lab.state.sim_time_s.toFixed(0)} s, ${await lines.count()} lines`);
}

async function soak({ browser, server }) {
  const { meter, lab } = await openMeasured(browser, server.url);
  await until('the operator', async () => (await lab.text('role')) === 'operator');
  await lab.reset();
  await lab.run();
  const chance = random(SEED);
  await fill(lab, chance);
  const counts = [];
  const samples = [];
  for (let minute = 1; minute <= MINUTES; minute++) {
    const end = Date.now() + MINUTE_MS;
    await meter.start();
    while (Date.now() < end) await play(lab, chance, 3000 + 5000 * chance());
    counts.push(await meter.stop());
    const sample = {
      minute,
      ...(await meter.memory()),
      server_rss_bytes: await rssBytes(server.pid),
    };
    samples.push({ ...sample, ...figuresOf(counts.slice(-1)) });
    const mb = (bytes) => (bytes === undefined ? '–' : (bytes / 1e6).toFixed(1));
    console.log(
      `${String(minute).padStart(3)} min: heap ${mb(sample.heap_bytes)} MB, ${sample.dom_nodes} nodes, ` +
        `${sample.listeners} listeners, server ${mb(sample.server_rss_bytes)} MB; ${words(samples.at(-1))}`,
    );
  }
  await lab.pause();
  await meter.start();
  await stepThrough(lab, STEPS);
  const { step_to_frame_p95_ms } = figuresOf([await meter.stop()]);
  return { samples, figures: { ...figuresOf(counts), step_to_frame_p95_ms } };
}

function median(samples, name) {
  const sorted = samples.map((sample) => sample[name]).sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)];
}

/** What grew by more than it may since things had settled: the middle of some minutes, since one alone may be odd. */
function growth(samples) {
  const from = samples.findIndex(({ minute }) => minute === SETTLED_MINUTES);
  const settled = samples.slice(from, from + COMPARED_MINUTES);
  const last = samples.slice(-COMPARED_MINUTES);
  return GROWS.filter((name) => median(last, name) > median(settled, name) * (1 + MOST_GROWTH)).map(
    (name) => `${name} went from ${median(settled, name)} to ${median(last, name)}`,
  );
}

const server = await startServer();
const browser = await startBrowser();
const watch = new Watch(browser, server.url);
try {
  const { samples, figures } = await soak({ browser, server });
  const faults = [
    ...overruns(figures),
    ...growth(samples),
    ...watch.complaints,
    ...watch.strangers,
  ];
  await mkdir(OUTPUT, { recursive: true });
  await writeFile(
    `${OUTPUT}soak.json`,
    `${JSON.stringify({ minutes: MINUTES, seed: SEED, figures, faults, samples }, null, 2)}\n`,
  );
  console.log(`in all: ${words(figures)}, step to frame p95 ${figures.step_to_frame_p95_ms} ms`);
  for (const fault of faults) console.log(`FAIL  ${fault}`);
  process.exitCode = faults.length === 0 ? 0 : 1;
} finally {
  await browser.close();
  await server.stop();
}
