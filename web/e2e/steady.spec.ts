// Nothing on the page moves by itself: the browser's own measure of layout shifts (CLS).

import { setTimeout as delay } from 'node:timers/promises';
import type { Page } from '@playwright/test';
import { LONG, Lab, expect, test } from './fixtures';
import { CONTROL_STEP_TICKS } from './support/stepper';
import { until } from './support/wait';

const MAX_SHIFT = 0.01;
/** Long enough that each message is drawn alone. */
const SLOW_FRAME_MS = 50;
/** At 64 times real time, on a busy machine. */
const TEN_MINUTES_MS = 100_000;
/** `STEADY_MINUTES=5` repeats the events for five minutes. */
const LEAST_MS = Number(process.env.STEADY_MINUTES ?? 0) * 60_000;
const LINK = '#v=1&map=posts&controller=attractor&seed=1';
const DELIVERS = `${LINK}&start=-0.25,-0.37&goal=0.24,-0.36`;
/** In front of the middle of a wall. */
const STOPS = `${LINK}&start=-0.05,-0.3&goal=0.13,-0.3&attractor_law=literal`;
/** So low that the magnet lifts the bead. */
const LIFTS = `${LINK}&start=-0.25,-0.37&goal=0.24,-0.36&tool_height_m=0.09`;
const KINDS = ['goal', 'disturbance', 'switch', 'reached', 'delivered', 'stopped', 'lift_off'];

declare global {
  interface Window {
    ferryShift: { cls: number; sum: number; worst: string[] };
  }
}

interface LayoutShift extends PerformanceEntry {
  readonly value: number;
  readonly hadRecentInput: boolean;
  readonly sources: readonly { readonly node?: Node | null }[];
}

/**
 * Runs in the page before its scripts. CLS is the largest sum of shifts in a window of at most five seconds, which ends
 * with a second without any (https://web.dev/articles/cls).
 */
function observeShifts() {
  const shift: Window['ferryShift'] = { cls: 0, sum: 0, worst: [] };
  window.ferryShift = shift;
  let [first_ms, last_ms, windowed] = [-Infinity, -Infinity, 0];
  new PerformanceObserver((list) => {
    for (const entry of list.getEntries() as LayoutShift[]) {
      // A change that follows an input is expected.
      if (entry.hadRecentInput) continue;
      const { startTime: now_ms, value } = entry;
      if (now_ms - last_ms > 1000 || now_ms - first_ms > 5000) [first_ms, windowed] = [now_ms, 0];
      last_ms = now_ms;
      windowed += value;
      shift.sum += value;
      shift.cls = Math.max(shift.cls, windowed);
      const parts = entry.sources.map(({ node }) =>
        node instanceof Element ? node.className || node.tagName : String(node?.nodeName),
      );
      shift.worst.push(`${value.toFixed(4)} ${parts.join(', ')}`);
    }
  }).observe({ type: 'layout-shift', buffered: true });
}

const shiftOf = (page: Page) => page.evaluate(() => window.ferryShift);

test('does not move when messages arrive one by one', async ({ page, session }) => {
  await page.addInitScript(observeShifts);
  await page.routeWebSocket(/./, (socket) => {
    const server = socket.connectToServer();
    let last = Promise.resolve();
    server.onMessage((message) => {
      last = last.then(async () => {
        await delay(SLOW_FRAME_MS);
        socket.send(message);
      });
    });
  });
  const lab = await Lab.attach(page, session.url);
  await lab.page.locator('.status-words').getByText('Click the map to set a goal').waitFor();
  await delay(10 * SLOW_FRAME_MS);
  const { cls, worst } = await shiftOf(page);
  expect(cls, worst.join('\n')).toBeLessThan(MAX_SHIFT);
});

test('keeps the switching law in its place when the first decision comes', async ({ lab }) => {
  const law = lab.page.getByTestId('reason');
  const decision = lab.page.getByTestId('rl-taken');
  await lab.reset();
  await lab.controller('RL');
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.25, 0.4).at(-1) ?? [0, 0]);
  await expect(decision).toHaveCount(0);
  const before = await law.boundingBox();
  await lab.stepUntil('a decision', async () => (await decision.count()) > 0, CONTROL_STEP_TICKS);
  expect(await law.boundingBox()).toEqual(before);
});

test('does not move while a session runs', LONG, async ({ page, session, openLab }) => {
  test.setTimeout(TEN_MINUTES_MS + 140_000);
  await page.addInitScript(observeShifts);
  const lab = await Lab.attach(page, session.url);
  await lab.reset({ speed: '8' });
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.25, 0.4).at(-1) ?? [0, 0]);
  await lab.run();
  await until('transport', () => lab.state.leg_steps > 4);
  const other = await openLab();
  await other.button('Take control').click();
  await lab.button('Give control').waitFor();
  // Otherwise it gets control when this page sends nothing for 30 s.
  await other.page.close();
  await lab.delivered(1);
  // Past 10 s, a minute and ten minutes of simulated time.
  await lab.speed('64');
  await until('ten minutes', () => lab.state.sim_time_s > 605, TEN_MINUTES_MS);
  await lab.pause();
  const { cls, sum, worst } = await shiftOf(page);
  console.log(`CLS ${cls.toFixed(4)}, all shifts ${sum.toFixed(4)}`);
  expect(cls, worst.join('\n')).toBeLessThan(MAX_SHIFT);
});

/** Sets an experiment up without a reload, and runs it. */
async function runLink(lab: Lab, link: string, speed = '8') {
  const { trial } = lab.scene;
  await lab.page.evaluate((hash) => {
    // The same hash again would not change it.
    location.hash = '';
    location.hash = hash;
  }, link);
  await until('the experiment', () => lab.scene.trial > trial);
  await lab.speed(speed);
  await lab.run();
}

test('does not move when something happens', LONG, async ({ page, session, openLab }) => {
  test.setTimeout(LEAST_MS + 180_000);
  await page.addInitScript(observeShifts);
  const end = Date.now() + LEAST_MS;
  const lab = await Lab.attach(page, session.url);
  do {
    // Slow, so that a busy machine does not miss the transport.
    await runLink(lab, DELIVERS, '2');
    await until('transport', () => lab.state.leg_steps > 14);
    // The bead must not move away from the pointer.
    await lab.pause();
    await lab.speed('8');
    await lab.startDrag([-0.14, -0.5]);
    await page.mouse.up();
    await lab.run();
    await lab.delivered(1);
    await runLink(lab, STOPS);
    await lab.page.getByRole('status', { name: 'Not delivered' }).waitFor();
    const other = await openLab();
    await other.button('Take control').click();
    await lab.button('Give control').waitFor();
    await other.page.close();
    await runLink(lab, LIFTS);
    await until('the lift-off', () => lab.events.some(({ kind }) => kind === 'lift_off'));
  } while (Date.now() < end);
  const kinds: ReadonlySet<string> = new Set(lab.events.map(({ kind }) => kind));
  expect(KINDS.filter((kind) => !kinds.has(kind))).toEqual([]);
  const { cls, sum, worst } = await shiftOf(page);
  console.log(`CLS ${cls.toFixed(4)}, all shifts ${sum.toFixed(4)}`);
  expect(cls, worst.join('\n')).toBeLessThan(MAX_SHIFT);
});
