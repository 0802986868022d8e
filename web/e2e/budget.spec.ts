// Budgets of the page: download size, script time per frame, and delay to the screen.
// Other tests run at the same time, so a time may be LENIENCY times its budget.

import { LONG, Lab, expect, test } from './fixtures';
import { Meter, figuresOf, overruns, stepThrough, summaryOf } from './support/meter';
import { must, until } from './support/wait';

/** Pages, scripts and styles. */
const MAX_TEXT_BYTES = 130_000;
const MAX_FONT_BYTES = 48.5e3;
const LENIENCY = 3;
const RUN_TICKS = 625;
const FRAMES_PER_S = 60;
const STEPS = 30;
/** Another program may take the processors for some seconds, so the measurement is repeated. */
const ATTEMPTS = 3;
const MOVING_WALLS = '#v=1&map=colon&controller=attractor&seed=1&peristalsis_amplitude_m=0.02';
/** The delays depend on the server, too. */
const NOT_MEASURED = { state_to_frame_p95_ms: undefined, step_to_frame_p95_ms: undefined };

test('loads at most 130 kB of text and one font', async ({ page, session }, testInfo) => {
  const network = await page.context().newCDPSession(page);
  await network.send('Network.enable');
  const loaded: { type: string; url: string }[] = [];
  network.on('Network.responseReceived', ({ type, response }) => {
    loaded.push({ type, url: response.url });
  });
  await Lab.attach(page, session.url);
  await page.waitForLoadState('load');
  /** Bytes that travel without brotli, which browsers take from an encrypted connection only. */
  const bytesOf = async (...types: string[]) => {
    const sizes = loaded
      .filter(({ type }) => types.includes(type))
      .map(async ({ url }) => {
        const { headers } = await fetch(url, { headers: { 'accept-encoding': 'gzip' } });
        return Number(headers.get('content-length') ?? NaN);
      });
    return (await Promise.all(sizes)).reduce((sum, size) => sum + size, 0);
  };
  const [text, font] = [await bytesOf('Document', 'Script', 'Stylesheet'), await bytesOf('Font')];
  const description = `${text} bytes of text, ${font} of the font, in ${loaded.length} parts`;
  testInfo.annotations.push({ type: 'figures', description });
  expect(loaded.length).toBeGreaterThan(2);
  expect(text).toBeLessThanOrEqual(MAX_TEXT_BYTES);
  expect(font).toBeGreaterThan(0);
  expect(font).toBeLessThanOrEqual(MAX_FONT_BYTES);
});

/** Steps the session, then runs it, and returns the figures of both. */
async function measure(meter: Meter, lab: Lab) {
  await lab.reset();
  await stepThrough(lab, 3);
  await meter.start();
  await stepThrough(lab, STEPS);
  const { step_to_frame_p95_ms } = figuresOf([await meter.stop()]);
  await lab.setGoal(must(lab.freePoints(await lab.bead(), 0.25, 0.4).at(-1), 'a goal'));
  await lab.run();
  await until('one second', () => lab.state.sim_time_s > 1);
  await meter.start();
  await lab.later(RUN_TICKS);
  const figures = { ...figuresOf([await meter.stop()]), step_to_frame_p95_ms };
  await lab.pause();
  expect(figures.states).toBeGreaterThan(20);
  expect(step_to_frame_p95_ms).toBeGreaterThan(0);
  return figures;
}

test('keeps its time budgets', LONG, async ({ page, session }, testInfo) => {
  const meter = await Meter.attach(page);
  const lab = await Lab.attach(page, session.url);
  let over: string[] = [];
  for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
    const figures = await measure(meter, lab);
    testInfo.annotations.push({ type: 'figures', description: summaryOf(figures) });
    over = overruns(figures, LENIENCY);
    if (over.length === 0) break;
  }
  expect(over, `${LENIENCY} times the budget`).toEqual([]);
});

test(
  'keeps its frames and its script time while the walls move',
  LONG,
  async ({ page, session }, testInfo) => {
    const meter = await Meter.attach(page);
    const lab = await Lab.attach(page, `${session.url}${MOVING_WALLS}`);
    await until('the experiment', () => lab.scene.parameters.peristalsis_amplitude_m === 0.02);
    await lab.run();
    await until('moved walls', () => Math.max(...(lab.state.wave_m ?? [0])) > 0.01);
    let over: string[] = [];
    for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
      await meter.start();
      await lab.later(RUN_TICKS);
      const figures = figuresOf([await meter.stop()]);
      testInfo.annotations.push({ type: 'figures', description: summaryOf(figures) });
      expect(figures.frames).toBeGreaterThan(10);
      over = overruns({ ...figures, ...NOT_MEASURED }, LENIENCY);
      if (figures.frames_per_s < FRAMES_PER_S / LENIENCY) {
        over.push(`${figures.frames_per_s.toFixed(1)} frames per second, wanted ${FRAMES_PER_S}`);
      }
      if (over.length === 0) break;
    }
    expect(over, `${LENIENCY} times the budget`).toEqual([]);
  },
);
