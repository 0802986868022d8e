// Sessions by their address: whose page it is, and what becomes of it when the server goes or the session ends.

import { violations } from './axe.mjs';
import { check, startBrowser, startOwnServer, until } from './harness.mjs';
import { LEAST_PX, controls, faultsOf } from './inventory.mjs';
import { Lab, OUTPUT } from './lab.mjs';

async function standBesideEachOther({ lab, browser, server }) {
  await lab.reset();
  const anna = await Lab.open(browser, `${server.url}/s/anna`);
  try {
    const { page } = anna;
    check((await anna.text('session-name')).includes('anna'), 'the page does not say whose it is');
    check((await page.title()) === 'anna – Ferry', `the tab says ${await page.title()}`);
    check((await lab.page.getByTestId('session-name').count()) === 0, 'main bears a name');
    check((await anna.text('role')) === 'operator', 'the operator of main is that of anna');
    check((await lab.text('role')) === 'operator', 'the operator of anna is that of main');
    await anna.run();
    await until('time', () => anna.state.tick > 50);
    check(!lab.state.running && lab.state.tick === 0, 'anna moved the time of main');

    // What the page asks besides is about its own session.
    await anna.click(anna.freePoints(await anna.point('bead'), 0.2, 0.3)[0]);
    await until('a goal', () => anna.state.goal_m);
    const asked = (path) => page.waitForRequest((one) => one.url().includes(path));
    const flow = asked('/api/sessions/anna/flow');
    await anna.layer('Attractor flow');
    await flow;
    const values = asked('/api/sessions/anna/values');
    await anna.layer('Value');
    await values;
    const moment = asked('/api/sessions/anna/moments/');
    await page
      .getByRole('button', { name: /^Why: / })
      .last()
      .click();
    await moment;
    await page.getByRole('dialog').getByRole('button', { name: 'Close' }).click();
    const kept = page.getByRole('link', { name: 'Keep as test case' });
    check((await kept.getAttribute('href')).includes('/anna/'), 'the case is another session’s');
    await anna.button('Share').click();
    const link = await page.getByLabel('Link to this experiment').inputValue();
    check(link.startsWith(`${server.url}/s/anna#`), `the link is ${link}`);
    await page.keyboard.press('Escape');
    for (const name of ['Attractor flow', 'Value']) await anna.layer(name, false);
    await anna.pause();
  } finally {
    await anna.page.context().close();
  }
}

/** Only `main` is there from the start: the page asks for its own again. */
async function outlivesItsServer() {
  if (!process.env.FERRY_BIN) return;
  let server = await startOwnServer();
  // A browser of its own: that a server is gone is an error on the console.
  const browser = await startBrowser();
  try {
    const lab = await Lab.open(browser, `${server.url}/s/anna`);
    await lab.run();
    await until('time', () => lab.state.tick > 50);
    const { port } = new URL(server.url);
    await server.stop();
    await until('no connection', async () => (await lab.text('connection')) !== 'live');
    server = await startOwnServer({ port });
    await until('live', async () => (await lab.text('connection')) === 'live', 30_000);
    await until('a fresh session', () => lab.state.tick === 0 && lab.hello.session === 'anna');
    await until('Run', () => lab.button('Run').isEnabled());
  } finally {
    await browser.close();
    await server.stop();
  }
}

/** A fault cannot be asked for: the page is told of one. */
async function saysWhyItEnded({ browser, server }) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  try {
    let has = 0;
    await page.routeWebSocket(/\/live$/, (socket) => {
      has += 1;
      const isFirst = has === 1;
      socket.connectToServer().onMessage((text) => {
        const message = typeof text === 'string' ? JSON.parse(text) : undefined;
        if (!isFirst || message?.type !== 'state') {
          socket.send(text);
          return;
        }
        socket.send(JSON.stringify({ ...message, ended: 'the camera was lost' }));
        void socket.close({ code: 1001, reason: 'the session has ended' });
      });
    });
    await page.goto(`${server.url}/s/bert`);
    await page.getByText('The session has ended: the camera was lost').waitFor();
    await page.getByText('session ended').waitFor();
    check(
      await page.getByRole('button', { name: 'Run', exact: true }).isDisabled(),
      'Run is offered',
    );
    // What has ended is not begun anew by itself.
    await page.waitForTimeout(1500);
    check(has === 1, 'the page went back to an ended session');
    await page.getByRole('button', { name: 'Begin anew' }).click();
    await until(
      'a session',
      async () => (await page.getByTestId('connection').innerText()) === 'live',
    );
    check((await page.getByRole('button', { name: 'Begin anew' }).count()) === 0, 'it still ended');
  } finally {
    await page.context().close();
  }
}

/** What was meant under an operator's lease does not happen under another's. */
async function actsUnderItsLease({ lab }) {
  await lab.reset();
  await lab.button('Step').click();
  await until('a step', () => lab.state.tick === 1);
  check(lab.sent.step.epoch === lab.hello.epoch, `a step went under ${lab.sent.step.epoch}`);
  await lab.page.evaluate(() => {
    const { send } = window.WebSocket.prototype;
    window.WebSocket.prototype.send = function (text) {
      window.WebSocket.prototype.send = send;
      const message = JSON.parse(text);
      send.call(this, JSON.stringify({ ...message, epoch: message.epoch - 1 }));
    };
  });
  await lab.button('Run').click();
  await lab.notice('session').getByText('control has passed on').waitFor();
  check(!lab.state.running, 'a stale command was obeyed');
  await lab.notice('session').getByRole('button', { name: 'Dismiss' }).click();
}

/** A mistyped address, read by a person. */
async function saysWhatIsNoName({ server }) {
  // A browser of its own: what is refused is an error on the console.
  const browser = await startBrowser();
  try {
    const page = await browser.newPage({ viewport: { width: 900, height: 600 } });
    await page.goto(`${server.url}/s/Anna%20B`);
    for (const colorScheme of ['dark', 'light']) {
      await page.emulateMedia({ colorScheme });
      const faults = [
        ...(await violations(page)),
        ...faultsOf(await controls(page), LEAST_PX.mouse),
      ];
      check(faults.length === 0, faults.join('\n      '));
      await page.screenshot({ path: `${OUTPUT}refused-${colorScheme}.png` });
    }
    const words = await page.locator('.reason').innerText();
    check(words.includes('Anna B') && words.includes('a to z'), `it says: ${words}`);
    await page.getByRole('link', { name: 'Session main' }).click();
    await until(
      'the session',
      async () => (await page.getByTestId('connection').innerText()) === 'live',
    );
  } finally {
    await browser.close();
  }
}

export const SESSIONS = [
  ['has a session for each address', standBesideEachOther],
  ['opens its session again on another server', outlivesItsServer],
  ['says why its session ended, and begins anew', saysWhyItEnded],
  ['acts under its lease', actsUnderItsLease],
  ['says what is no name of a session', saysWhatIsNoName],
];
