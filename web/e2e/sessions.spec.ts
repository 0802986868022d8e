// Sessions by address: whose page it is, and what happens when the server restarts or the session ends.

import { expect, test } from './fixtures';
import { violations } from './support/axe';
import { LEAST_PX, controls, faultsOf } from './support/inventory';
import { Server } from './support/server';
import { until } from './support/wait';

const GONE = /ERR_CONNECTION_REFUSED|WebSocket connection/i;
const ENDED = /The session has ended: the camera was lost/i;
const RESTART = 'Restart';
const PASSED_ON = /control has passed on/i;

test('has a session for each address', async ({ lab, openLab, newSession }) => {
  const second = newSession();
  const other = await openLab({ url: second.url });
  const { page } = other;
  await expect(page.getByTestId('session-name')).toContainText(second.name);
  await expect(page).toHaveTitle(`${second.name} – Ferry`);
  await other.isRole('operator');
  await lab.isRole('operator');
  await other.run();
  await until('time', () => other.state.tick > 50);
  expect(lab.state.running).toBe(false);
  expect(lab.state.tick, 'one session moved the time of another').toBe(0);

  // What the page requests besides is about its own session.
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
  await page
    .getByRole('button', { name: /^Why: / })
    .last()
    .click();
  await moment;
  await page.getByRole('dialog').getByRole('button', { name: 'Close' }).click();
  const kept = page.getByRole('link', { name: 'Keep as test case' });
  await expect(kept).toHaveAttribute('href', new RegExp(`/${second.name}/`));
  await other.button('Share').click();
  const link = page.getByLabel('Link to this experiment');
  expect(await link.inputValue()).toContain(`${second.url}#`);
});

test('gives the session main no name', async ({ openLab, server }) => {
  const main = await openLab({ url: server.url });
  await expect(main.page.getByTestId('session-name')).toHaveCount(0);
  expect(main.hello.session).toBe('main');
});

test('opens its session again on another server', async ({ openLab, watch }) => {
  watch.allow(GONE);
  let server = await Server.start();
  try {
    watch.allowHost(server.url);
    const lab = await openLab({ url: `${server.url}/s/anna` });
    await lab.run();
    await until('time', () => lab.state.tick > 50);
    const { port } = server;
    await server.stop();
    const connection = lab.page.getByTestId('connection');
    await expect(connection).not.toHaveText('live');
    server = await Server.start({ port });
    await expect(connection).toHaveText('live', { timeout: 30_000 });
    await until('a fresh session', () => lab.state.tick === 0 && lab.hello.session === 'anna');
    await expect(lab.button('Run')).toBeEnabled();
  } finally {
    await server.stop();
  }
});

/** The page receives that its session has ended: a fault cannot be caused on purpose. */
test('says why its session ended, and restarts it', async ({ page, session }) => {
  let connections = 0;
  await page.routeWebSocket(/\/live$/, (socket) => {
    connections += 1;
    const isFirst = connections === 1;
    const server = socket.connectToServer();
    server.onMessage((text) => {
      const message =
        typeof text === 'string' ? (JSON.parse(text) as { type?: string }) : undefined;
      if (!isFirst || message?.type !== 'state') {
        socket.send(text);
        return;
      }
      socket.send(JSON.stringify({ ...message, ended: 'the camera was lost' }));
      void socket.close({ code: 1001, reason: 'the session has ended' });
    });
  });
  // The timers of the page run when they are told.
  await page.clock.install();
  await page.goto(session.url);
  await expect(page.getByText(ENDED)).toBeVisible();
  await expect(page.getByText('session ended')).toBeVisible();
  await expect(page.getByRole('button', { name: 'Run', exact: true })).toBeDisabled();
  // An ended session is not opened again by itself.
  await page.clock.runFor(10_000);
  expect(connections).toBe(1);
  const restart = page.getByRole('button', { name: RESTART });
  await restart.click();
  await page.clock.runFor(1000);
  await expect(page.getByTestId('connection')).toHaveText('live');
  await expect(restart).toHaveCount(0);
});

test('acts under its lease', async ({ lab }) => {
  await lab.button('Step').click();
  await until('a step', () => lab.state.tick === 1);
  expect(lab.sent.step).toMatchObject({ epoch: lab.hello.epoch });
  // What was meant under one lease does not happen under another.
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
  await expect(lab.notice('session').getByText(PASSED_ON)).toBeVisible();
  expect(lab.state.running, 'a stale command was obeyed').toBe(false);
  await lab.notice('session').getByRole('button', { name: 'Dismiss' }).click();
});

test('explains an address that is not the name of a session', async ({ page, server, watch }) => {
  watch.allow(/status of 404/);
  await page.goto(`${server.url}/s/Anna%20B`);
  for (const colorScheme of ['dark', 'light'] as const) {
    await page.emulateMedia({ colorScheme });
    expect(await violations(page)).toEqual([]);
    expect(faultsOf(await controls(page), LEAST_PX.mouse)).toEqual([]);
  }
  const reason = page.locator('.reason');
  await expect(reason).toContainText('Anna B');
  await expect(reason).toContainText('a to z');
  await page.getByRole('link', { name: 'Session main' }).click();
  await expect(page.getByTestId('connection')).toHaveText('live');
  await expect(page).toHaveURL(`${server.url}/`);
});
