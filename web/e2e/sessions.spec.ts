// Sessions by address: restart of the server, end of a session, stale commands, invalid names.

import { expect, test } from './fixtures';
import { violations } from './support/axe';
import { endFirstSession } from './support/ended';
import { skipFirstVisit } from './support/lab';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { Server } from './support/server';
import { until } from './support/wait';
import { CONNECTION_LOST } from './support/watch';

const ENDED = /The session has ended: the camera was lost/i;
const RESTART = 'Restart';
const GOES_ON = /This session was interrupted\. It goes on at/;
const STARTED_OVER = /This session was interrupted\. It started over/;
const PASSED_ON = /another browser took control/i;

test('opens one session per address', async ({ lab, openLab, newSession }) => {
  const second = newSession();
  const other = await openLab({ url: second.url });
  const { page } = other;
  await other.button('More').click();
  await expect(page.getByTestId('session-name')).toHaveText(second.name);
  await page.keyboard.press('Escape');
  await expect(page).toHaveTitle(`${second.name} – Ferry`);
  await other.isRole('operator');
  await lab.isRole('operator');
  await other.step(50);
  expect(lab.state.running).toBe(false);
  expect(lab.state.tick, 'the tick of a paused session').toBe(0);

  // The page's HTTP requests and links name its own session.
  await other.setGoal(other.freePoints(await other.bead(), 0.2, 0.3)[0]);
  const api = `/api/sessions/${second.name}`;
  const requested = (path: string) => page.waitForRequest((one) => one.url().includes(path));
  const flow = requested(`${api}/flow`);
  await other.layer('Attractor flow');
  await flow;
  const values = requested(`${api}/values`);
  await other.layer('Value');
  await values;
  const moment = requested(`${api}/moments/`);
  await other.panel('Story');
  await page
    .getByRole('button', { name: /^Why: / })
    .last()
    .click();
  await moment;
  await page.getByRole('dialog').getByRole('button', { name: 'Close' }).click();
  const testCase = page.getByRole('link', { name: 'Keep as test case' });
  await expect(testCase).toHaveAttribute('href', new RegExp(`/${second.name}/`));
  await other.button('Share').click();
  await expect(page.getByLabel('Link: Watch this')).toHaveValue(`${second.url}?watch`);
});

test('the browser’s tab does not name the session main', async ({ openLab, server }) => {
  const main = await openLab({ url: server.url });
  await expect(main.page).toHaveTitle('Ferry');
  await main.button('More').click();
  await expect(main.page.getByTestId('session-name')).toHaveText('main');
  expect(main.hello.session).toBe('main');
});

test('opens its session again after the server restarts', async ({ openLab, watch }) => {
  watch.allow(CONNECTION_LOST);
  let server = await Server.start();
  try {
    watch.allowHost(server.url);
    const lab = await openLab({ url: `${server.url}/s/anna` });
    await lab.run();
    await until('50 ticks', () => lab.state.tick > 50);
    const { port } = server;
    await server.stop();
    await lab.isConnection('lost');
    server = await Server.start({ port });
    await lab.isConnection('live');
    await until('a fresh session', () => lab.state.tick === 0 && lab.hello.session === 'anna');
    await expect(lab.button('Run')).toBeEnabled();
  } finally {
    await server.stop();
  }
});

test('goes on where the server stopped, and says so', async ({ openLab, watch }) => {
  watch.allow(CONNECTION_LOST);
  let server = await Server.start({ scenario: null });
  try {
    watch.allowHost(server.url);
    const lab = await openLab({ url: `${server.url}/s/anna` });
    await lab.controller('ERRT');
    await lab.tune('Threshold T', '8');
    await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
    await lab.step(50);
    await lab.reset();
    await lab.step(30);
    const { tick, goal_m, bead_m } = lab.state;
    const { port, data } = server;
    await server.end();
    await lab.isConnection('lost');
    server = await Server.start({ port, data, scenario: null });
    await lab.isConnection('live');
    await expect(lab.notice('transport')).toContainText(GOES_ON);
    expect(lab.state).toMatchObject({ tick, goal_m, bead_m, running: false, controller: 'errt' });
    expect(lab.scene.parameters.threshold_m).toBe(0.08);
    expect(lab.scene.kept_runs).toHaveLength(1);
    await lab.step(20);

    // A chosen scenario comes first; what was saved is a kept run.
    await server.end();
    await lab.isConnection('lost');
    server = await Server.start({ port, data });
    await lab.isConnection('live');
    await expect(lab.notice('transport')).toContainText(STARTED_OVER);
    await until('the kept runs', () => lab.state.tick === 0 && lab.scene.kept_runs.length === 2);
  } finally {
    await server.stop();
  }
});

test('shows why its session ended, and restarts it', async ({ page, session }) => {
  const connections = await endFirstSession(page);
  // The test advances the page's timers.
  await page.clock.install();
  await skipFirstVisit(page);
  await page.goto(session.url);
  await expect(page.locator('.status-words')).toContainText(ENDED);
  await expect(page.getByTestId('connection')).toHaveAttribute('data-link', 'ended');
  await expect(page.getByRole('button', { name: 'Run', exact: true })).toBeDisabled();
  // The page does not reopen an ended session by itself.
  await page.clock.runFor(10_000);
  expect(connections()).toBe(1);
  const restart = page.getByRole('button', { name: RESTART });
  await restart.click();
  await page.clock.runFor(1000);
  await expect(page.getByTestId('connection')).toHaveAttribute('data-link', 'live');
  await expect(restart).toHaveCount(0);
});

test('sends the epoch of its lease, and the server refuses an earlier one', async ({ lab }) => {
  await lab.button('Step').click();
  await until('a step', () => lab.state.tick === 1);
  expect(lab.sent.step).toMatchObject({ epoch: lab.hello.epoch });
  // The next command has the epoch of an earlier lease.
  await lab.page.evaluate(() => {
    const { prototype } = window.WebSocket;
    // eslint-disable-next-line @typescript-eslint/unbound-method
    const { send } = prototype;
    prototype.send = function (this: WebSocket, text) {
      prototype.send = send;
      const message = JSON.parse(text as string) as { epoch: number };
      send.call(this, JSON.stringify({ ...message, epoch: message.epoch - 1 }));
    };
  });
  await lab.button('Run').click();
  await expect(lab.notice('transport').getByText(PASSED_ON)).toBeVisible();
  expect(lab.state.running, 'the server carried out a stale command').toBe(false);
  await lab.notice('transport').getByRole('button', { name: 'Dismiss' }).click();
});

test('explains why a name in the address is invalid', async ({ page, server, watch }) => {
  watch.allow(/status of 404/);
  await skipFirstVisit(page);
  await page.goto(`${server.url}/s/Anna%20B`);
  for (const colorScheme of ['dark', 'light'] as const) {
    await page.emulateMedia({ colorScheme });
    expect(await violations(page)).toEqual([]);
    expect(faultsOf(await controls(page), MIN_SIDE_PX.mouse)).toEqual([]);
  }
  const reason = page.locator('.reason');
  await expect(reason).toContainText('Anna B');
  await expect(reason).toContainText('a to z');
  await page.getByRole('link', { name: 'Session main' }).click();
  await expect(page.getByTestId('connection')).toHaveAttribute('data-link', 'live');
  await expect(page).toHaveURL(`${server.url}/`);
});
