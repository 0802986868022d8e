// The demonstration: its programme, the visitor who interrupts it, a second screen, an outage, and the return.

import type { Page } from '@playwright/test';
import { LONG, Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { endFirstSession } from './support/ended';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { Server } from './support/server';
import { until } from './support/wait';
import { CONNECTION_LOST } from './support/watch';
import type { StateMessage } from './support/wire';

const CAPTION_MS = 90_000;
/** A caption stays for at least this time. */
const READ_MS = 2500;
const RECONNECT_MS = 30_000;
const SILENCE_MS = 61_000;
const FIRST = 'A magnet carries a bead through a maze.';
/** The further captions of the first part, and what each follows. */
const CAPTIONS: readonly (readonly [string, (state: StateMessage) => boolean])[] = [
  [
    'RL: a neural network steers. It sees only the camera picture.',
    ({ phase, leg_steps }) => phase.code === 'transporting' && leg_steps >= 18,
  ],
  ['Watch: the bead will be pulled away.', ({ leg_steps }) => leg_steps >= 52],
  [
    'The bead is pulled away. The arm flies straight to it.',
    ({ disturbances, mode }) => disturbances === 1 && mode === 1,
  ],
  [
    'Fetched. It carries on.',
    ({ phase, leg_steps }) => phase.code === 'transporting' && leg_steps < 60,
  ],
  ['Delivered.', ({ deliveries }) => deliveries === 1],
];
/** A software renderer draws the 3-D view slowly. */
const SMALL = { width: 480, height: 320 };
const VISITED = /^(You are in control|The bead is lost|Delivered\. Touch)/;
const WATCHING = 'Another screen runs this demonstration';
const WAITING = /^One moment/;

const captionOf = (page: Page) => page.locator('.demo-caption');
const badgeOf = (page: Page) => page.locator('.demo-badge');

declare global {
  interface Window {
    ferryCaptions: string[];
  }
}

/** Runs in the page before its scripts. The test may look for the first caption too late. */
function keepCaptions() {
  window.ferryCaptions = [];
  new MutationObserver(() => {
    const text = document.querySelector('.demo-caption')?.textContent.trim() ?? '';
    if (text !== '' && text !== window.ferryCaptions.at(-1)) window.ferryCaptions.push(text);
  }).observe(document, { subtree: true, childList: true, characterData: true });
}

/** Runs in the page before its scripts. */
function hideWebGl() {
  const { prototype } = HTMLCanvasElement;
  // eslint-disable-next-line @typescript-eslint/unbound-method
  const { getContext } = prototype;
  prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
    return kind === 'webgl2' ? null : (getContext.call(this, kind, ...rest) as unknown);
  } as typeof getContext;
}

/** The clock by which the programme waits. */
const jump = (page: Page, ms: number) =>
  page.evaluate((ahead_ms) => {
    const now = performance.now.bind(performance);
    performance.now = () => now() + ahead_ms;
  }, ms);

/** Waits until the page has set up the first part. */
const begun = (lab: Lab) =>
  until(
    'the first experiment',
    () => lab.isComplete && lab.scene.map === 'colon' && lab.state.running,
  );

let server: Server;
test.beforeEach(async ({ watch }) => {
  server = await Server.start();
  watch.allowHost(server.url);
});
test.afterEach(async ({ page }) => {
  // A page that looks for its server would report that it has gone.
  await page.goto('about:blank');
  await server.stop();
});

test('runs its programme, gives way to a visitor, and returns', async ({ page }) => {
  await page.setViewportSize(SMALL);
  await page.addInitScript(keepCaptions);
  const lab = await Lab.watch(page, `${server.url}/demo`);
  await begun(lab);
  await lab.send({ type: 'pause' });
  await until('paused', () => !lab.state.running);
  expect(await violations(page)).toEqual([]);
  for (const [caption, when] of CAPTIONS) {
    await lab.stepUntil(caption, () => when(lab.state));
    await jump(page, READ_MS);
    await expect(captionOf(page)).toHaveText(caption);
  }
  const captions = [FIRST, ...CAPTIONS.map(([caption]) => caption)];
  expect(await page.evaluate(() => window.ferryCaptions)).toEqual(captions);

  await page.mouse.click(200, 200);
  await expect(captionOf(page)).toHaveText(VISITED);
  const { trial } = lab.scene;
  await jump(page, SILENCE_MS);
  await until('another experiment', () => lab.scene.trial > trial && lab.state.running);
  await until('the planner', () => lab.state.controller === 'errt');

  await page.keyboard.press('Escape');
  await page.getByRole('region', { name: 'Experiment' }).waitFor();
});

test(
  'shows a late screen, and one that is loaded again, the same badge, sentence and trail',
  LONG,
  async ({ page, browser }) => {
    await page.setViewportSize(SMALL);
    const first = await Lab.watch(page, `${server.url}/demo`);
    await begun(first);
    await first.send({ type: 'pause' });
    await until('paused', () => !first.state.running);
    const context = await browser.newContext();
    try {
      await context.addInitScript(hideWebGl);
      const start = await first.bead();
      await first.stepUntil('the transport', () => first.state.leg_steps > 20);
      const late = await Lab.watch(await context.newPage(), `${server.url}/demo`);
      await until('the same state', () => late.isComplete && late.state.tick === first.state.tick);
      const shown = async () => {
        await late.canvas.waitFor();
        await expect(badgeOf(late.page)).toHaveText('RL, a neural network');
        await expect(captionOf(late.page)).toHaveText('RL carries the bead to its goal.');
        await late.drawn();
        return late.pixelsAround(start, await late.bead());
      };
      const withTrail = await shown();
      await late.page.reload();
      expect(await shown()).toBe(withTrail);

      await first.stepUntil('the loss', () => first.state.mode === 1 && first.state.disturbances);
      await expect(badgeOf(late.page)).toHaveText('Fetching');
      await expect(captionOf(late.page)).toHaveText('The arm flies to the bead.');
      await late.page.goto('about:blank');
    } finally {
      await context.close();
    }
  },
);

test(
  'shows the ghosts of a challenge, and a visitor who touches the screen plays it',
  LONG,
  async ({ page }) => {
    const lab = await Lab.watch(page, `${server.url}/demo`);
    await begun(lab);
    // To the last part: each visitor who leaves lets the programme go on with the next one.
    while (!lab.scene.challenge) {
      const { trial } = lab.scene;
      await page.mouse.click(200, 200);
      await expect(captionOf(page)).toHaveText(VISITED);
      await jump(page, SILENCE_MS);
      await until('another experiment', () => lab.scene.trial > trial && lab.state.running);
    }
    await expect(captionOf(page)).toHaveText(/ needs \d+\.\d s\. Touch the screen/, {
      timeout: CAPTION_MS,
    });
    await until('some seconds of the ghosts', () => lab.state.tick > 250);
    expect(lab.state.steer_m).toBeNull();
    const { trial } = lab.scene;
    await page.mouse.move(500, 300);
    await page.mouse.down();
    await until('the start', () => lab.scene.trial > trial && lab.state.running);
    await page.mouse.move(600, 350, { steps: 5 });
    await until('the hand', () => lab.state.steer_m);
    await expect(captionOf(page)).toHaveText(/green circle: \d/);
    expect(lab.state.attempt?.void).toBeNull();
    await page.mouse.up();
  },
);

test(
  'goes to the plan view without WebGL 2, shows a refusal, and forgets a zoom',
  LONG,
  async ({ page }) => {
    await page.addInitScript(hideWebGl);
    const lab = await Lab.watch(page, `${server.url}/demo`);
    await begun(lab);
    await lab.canvas.waitFor();
    const scaleOf = async () => Number(await lab.canvas.getAttribute('data-px-per-m'));
    const whole = await scaleOf();
    const { trial } = lab.scene;
    await page.mouse.move(...(await lab.px(await lab.bead())));
    await page.mouse.wheel(0, -600);
    await expect.poll(scaleOf).toBeGreaterThan(1.5 * whole);
    await expect(captionOf(page)).toHaveText(VISITED);
    await jump(page, SILENCE_MS);
    await until('another experiment', () => lab.scene.trial > trial && lab.state.running);
    await expect.poll(scaleOf).toBe(whole);

    await lab.click(lab.wallPoint());
    await expect(lab.notice('workspace')).toBeVisible();
    expect(await violations(page)).toEqual([]);
    expect(faultsOf(await controls(page), MIN_SIDE_PX.mouse)).toEqual([]);
  },
);

test(
  'watches on a second screen, and goes on there when the first one leaves',
  LONG,
  async ({ page, browser }) => {
    await page.setViewportSize(SMALL);
    const first = await Lab.watch(page, `${server.url}/demo`);
    await begun(first);
    const context = await browser.newContext({ viewport: SMALL });
    try {
      await context.addInitScript(keepCaptions);
      const second = await Lab.watch(await context.newPage(), `${server.url}/demo`);
      await expect(second.page.getByText(WATCHING)).toBeVisible();
      await expect(captionOf(second.page)).toHaveText(/\.$/);
      expect(second.hello.role).toBe('viewer');
      // A touch is ignored.
      await second.page.mouse.click(300, 200);
      await first.later(250);
      await expect(second.page.getByText(WATCHING)).toBeVisible();
      expect(second.sent).toEqual({});
      expect(first.hello).toMatchObject({ role: 'operator', asked: false });

      const { trial } = second.scene;
      await page.goto('about:blank');
      const captions = () => second.page.evaluate(() => window.ferryCaptions);
      await until('the first caption', async () => (await captions()).includes(FIRST));
      await until('the part again', () => second.scene.trial > trial && second.state.running);
      expect(second.hello.role).toBe('operator');
      await second.page.goto('about:blank');
    } finally {
      await context.close();
    }
  },
);

test('waits for its server, and begins again', LONG, async ({ page, watch }) => {
  watch.allow(CONNECTION_LOST);
  const lab = await Lab.watch(page, `${server.url}/demo`);
  await begun(lab);
  const { opened } = lab.hello;
  const { port } = server;
  await server.stop();
  await expect(captionOf(page)).toHaveText(WAITING);
  // A page that loads itself again without a server is lost.
  await jump(page, SILENCE_MS);
  await page.waitForRequest(`${server.url}/demo`);
  lab.sent = {};
  server = await Server.start({ port });
  await expect(captionOf(page)).toHaveText(FIRST, { timeout: RECONNECT_MS });
  await until('the new session', () => lab.hello.opened !== opened);
  await until('the part again', () => lab.sent.load_scenario && lab.sent.run);
  await begun(lab);
});

test('loads itself again after its session has ended', LONG, async ({ page }) => {
  await page.setViewportSize(SMALL);
  const connections = await endFirstSession(page);
  await page.goto(`${server.url}/demo`);
  await expect(captionOf(page)).toHaveText(WAITING);
  await jump(page, SILENCE_MS);
  await expect(captionOf(page)).toHaveText(FIRST);
  expect(connections()).toBe(2);
});

test('returns to the session that it was opened from', LONG, async ({ page }) => {
  const url = `${server.url}/s/anna`;
  const lab = await Lab.attach(page, url);
  for (const leave of [
    () => page.getByRole('link', { name: 'Leave' }).click(),
    () => page.keyboard.press('Escape'),
  ]) {
    await lab.button('More').click();
    await page.getByRole('link', { name: 'Present' }).click();
    await page.getByRole('heading', { name: 'Demonstration' }).waitFor({ state: 'attached' });
    // *Leave* covers no line of the view.
    const slow = await lab.boxOf(page.locator('.scene-slow'));
    const link = await lab.boxOf(page.getByRole('link', { name: 'Leave' }));
    expect(slow.y).toBeGreaterThan(link.y + link.height);
    await leave();
    await page.waitForURL(url);
    await lab.live();
  }
});
