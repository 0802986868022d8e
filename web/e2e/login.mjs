// Who has the token gets in, and the token goes nowhere but into the body that asks.

import { execFileSync } from 'node:child_process';
import { violations } from './axe.mjs';
import { Watch, check, startBrowser, startOwnServer, until } from './harness.mjs';
import { LEAST_PX, controls, faultsOf } from './inventory.mjs';
import { Lab } from './lab.mjs';

/** What the browser itself says of a page that wants a token. */
const REFUSED = /^Failed to load resource: the server responded with a status of 401 /;

const newToken = () => execFileSync(process.env.FERRY_BIN, ['token'], { encoding: 'utf8' }).trim();
const field = (page) => page.getByLabel('Token', { exact: true });

/** Everything by which a page tells others where it is; what stands after the `#` is sent to nobody. */
function listen(context) {
  const told = [];
  const tell = (address) => told.push(address.split('#')[0]);
  context.on('request', (request) => {
    tell(request.url());
    told.push(request.headers().referer ?? '');
  });
  context.on('page', (page) => page.on('websocket', (socket) => tell(socket.url())));
  return told;
}

async function historyOf(page) {
  const cdp = await page.context().newCDPSession(page);
  const { entries } = await cdp.send('Page.getNavigationHistory');
  await cdp.detach();
  return entries.map(({ url }) => url);
}

async function isLive(page) {
  return (await page.getByTestId('connection').innerText()) === 'live';
}

async function logsInByHand(browser, url, token) {
  const context = await browser.newContext({ viewport: { width: 900, height: 600 } });
  const told = listen(context);
  const page = await context.newPage();
  await page.goto(`${url}/s/anna`);
  check(/Log in/.test(await page.title()), `without a token one sees ${await page.title()}`);
  for (const colorScheme of ['dark', 'light']) {
    await page.emulateMedia({ colorScheme });
    const faults = [...(await violations(page)), ...faultsOf(await controls(page), LEAST_PX.mouse)];
    check(faults.length === 0, faults.join('\n      '));
  }
  check(
    await field(page).evaluate((one) => one === document.activeElement),
    'it waits for a click',
  );
  await page.keyboard.type('ab'.repeat(32));
  await page.keyboard.press('Enter');
  await page.getByText('this is not the token').waitFor();
  // What was wrong is marked, and typed over.
  await page.keyboard.type(token);
  await page.keyboard.press('Enter');
  await page.getByTestId('connection').waitFor();
  await until('live', () => isLive(page));
  check(page.url() === `${url}/s/anna`, `logged in, one is at ${page.url()}`);
  check((await page.getByTestId('session-name').innerText()).includes('anna'), 'not at anna');
  const [cookie, ...others] = await context.cookies();
  check(others.length === 0, `there are ${1 + others.length} cookies`);
  check(cookie.httpOnly && cookie.sameSite === 'Strict', 'scripts or strangers may use the cookie');
  check(!cookie.value.includes(token), 'the cookie is the token');
  check((await page.evaluate(() => document.cookie)) === '', 'a script reads the cookie');

  // What the page asks is answered until the login has ended.
  await page.getByRole('button', { name: 'Recordings' }).click();
  await page.getByRole('heading', { name: 'Recordings' }).waitFor();
  await until('a list', async () => (await page.getByRole('row', { name: 'anna' }).count()) > 0);
  await context.clearCookies();
  await page.getByText('login has ended').waitFor();
  await page.getByRole('button', { name: 'Log in again' }).click();
  await field(page).waitFor();
  check(
    !told.concat(await historyOf(page)).some((one) => one.includes(token)),
    'the token got out',
  );
  await context.close();
}

/** A link that has the token after its `#`. */
async function logsInByLink(browser, url, token) {
  const context = await browser.newContext();
  const told = listen(context);
  const page = await context.newPage();
  for (const round of ['first', 'again']) {
    await page.goto(`${url}/s/anna#token=${token}`);
    await page.getByTestId('connection').waitFor();
    await until('live', () => isLive(page));
    check(page.url() === `${url}/s/anna`, `${round}, the address is ${page.url()}`);
    // Followed in the very tab: only what stands after `#` changes.
    const again = page.waitForEvent('load');
    await page.evaluate((link) => {
      document.location.href = link;
    }, `${url}/s/anna#token=${token}`);
    await again;
    await until('live again', () => isLive(page));
    check(page.url() === `${url}/s/anna`, `${round}, in the same tab, it is ${page.url()}`);
    await page.goto('about:blank');
  }
  const asked = told.concat(await historyOf(page)).filter((one) => one.includes(token));
  check(asked.length === 0, `the token is in ${asked.join(' ')}`);
  await context.close();
}

async function logsIn() {
  if (!process.env.FERRY_BIN) return;
  const token = newToken();
  const server = await startOwnServer({ token });
  const browser = await startBrowser();
  const { complaints, strangers } = new Watch(browser, server.url);
  try {
    await logsInByHand(browser, server.url, token);
    await logsInByLink(browser, server.url, token);
    const others = complaints.filter((one) => !REFUSED.test(one));
    check(others.length === 0, `the console says: ${others.join(' | ')}`);
    const foreign = strangers.filter((one) => !one.startsWith('about:'));
    check(foreign.length === 0, `requests left the server: ${foreign.join(' ')}`);
  } finally {
    await browser.close();
    await server.stop();
  }
}

/** The server comes back with another token: whoever had logged in is asked for it. */
async function hearsOfAnotherToken() {
  if (!process.env.FERRY_BIN) return;
  const token = newToken();
  let server = await startOwnServer({ token });
  const browser = await startBrowser();
  try {
    const page = await browser.newPage();
    const lab = new Lab(page);
    await page.goto(`${server.url}/#token=${token}`);
    await until('the first state', () => lab.state);
    const { port } = new URL(server.url);
    await server.stop();
    server = await startOwnServer({ port, token: newToken() });
    await page.getByText('login has ended').waitFor({ timeout: 30_000 });
    check(await lab.button('Run').isDisabled(), 'Run is offered');
  } finally {
    await browser.close();
    await server.stop();
  }
}

export const LOGIN = [
  ['asks for the token and gives it to nobody', logsIn],
  ['says when a login has ended', hearsOfAnotherToken],
];
