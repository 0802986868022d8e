// Login: a page with the token opens; the token is sent in one request body only.

import type { BrowserContext, Page } from '@playwright/test';
import { Lab, expect, test as base } from './fixtures';
import { violations } from './support/axe';
import { skipFirstVisit } from './support/lab';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { Server } from './support/server';
import { until } from './support/wait';
import { CONNECTION_LOST } from './support/watch';

/** The browser reports this for a page that needs a token. */
const REFUSED = /status of 401 /i;
const WRONG = 'the token is wrong';
const LOGIN_ENDED = 'login has ended';

interface Guarded {
  readonly url: string;
  readonly token: string;
}

const test = base.extend<{ guarded: Guarded }>({
  guarded: async ({ watch }, use) => {
    const token = Server.newToken();
    const server = await Server.start({ token });
    watch.allow(REFUSED);
    watch.allowHost(server.url);
    await use({ url: server.url, token });
    await server.stop();
  },
});

const field = (page: Page) => page.getByLabel('Token', { exact: true });
const isLive = (page: Page) =>
  expect(page.getByTestId('connection')).toHaveAttribute('data-link', 'live');

/** All addresses that a page sends. A browser does not send the part after the `#`. */
function addressesOf(context: BrowserContext) {
  const sent: string[] = [];
  const add = (address: string) => sent.push(address.split('#')[0] ?? '');
  context.on('request', (request) => {
    add(request.url());
    sent.push(request.headers().referer ?? '');
  });
  context.on('page', (page) => page.on('websocket', (socket) => add(socket.url())));
  return sent;
}

async function historyOf(page: Page) {
  const cdp = await page.context().newCDPSession(page);
  const { entries } = await cdp.send('Page.getNavigationHistory');
  await cdp.detach();
  return entries.map(({ url }) => url);
}

test('asks for the token, and sends it in the request body only', async ({ context, guarded }) => {
  const { url, token } = guarded;
  const addresses = addressesOf(context);
  const page = await context.newPage();
  await skipFirstVisit(page);
  await page.goto(`${url}/s/anna`);
  await expect(page).toHaveTitle(/Log in/);
  await expect(page.locator('main p').first()).toHaveText(/^Enter the token of this server/);
  for (const colorScheme of ['dark', 'light'] as const) {
    await page.emulateMedia({ colorScheme });
    expect(await violations(page)).toEqual([]);
    expect(faultsOf(await controls(page), MIN_SIDE_PX.mouse)).toEqual([]);
  }
  await expect(field(page)).toBeFocused();
  await page.keyboard.type('ab'.repeat(32));
  await page.keyboard.press('Enter');
  await page.getByText(WRONG).waitFor();
  // The page selects the wrong token, so that typing replaces it.
  await page.keyboard.type(token);
  await page.keyboard.press('Enter');
  await isLive(page);
  expect(page.url()).toBe(`${url}/s/anna`);
  await page.getByRole('button', { name: 'More', exact: true }).click();
  await expect(page.getByTestId('session-name')).toHaveText('anna');
  const cookies = await context.cookies();
  const [login, ...others] = cookies.map(({ name, httpOnly, sameSite }) => ({
    name,
    httpOnly,
    sameSite,
  }));
  expect(login).toEqual({ name: 'ferry', httpOnly: true, sameSite: 'Strict' });
  expect(others).toEqual([{ name: 'ferry-visitor', httpOnly: true, sameSite: 'Lax' }]);
  expect(JSON.stringify(cookies), 'the cookie is the token').not.toContain(token);
  expect(await page.evaluate(() => document.cookie), 'a script can read the cookie').toBe('');

  // The server answers requests until the login has ended.
  await page.getByRole('link', { name: 'Recordings' }).click();
  await page.getByRole('heading', { name: 'Recordings' }).waitFor();
  await expect(page.getByRole('row', { name: 'anna' }).first()).toBeVisible();
  await context.clearCookies();
  await page.getByText(LOGIN_ENDED).waitFor();
  await page.getByRole('button', { name: 'Log in again' }).click();
  await field(page).waitFor();
  expect([...addresses, ...(await historyOf(page))].join(' ')).not.toContain(token);
});

test('logs in by a link with the token after the #', async ({ context, guarded }) => {
  const { url, token } = guarded;
  const addresses = addressesOf(context);
  const page = await context.newPage();
  await skipFirstVisit(page);
  const link = `${url}/s/anna#token=${token}`;
  for (const round of ['first', 'again']) {
    await page.goto(link);
    await isLive(page);
    await expect(page, round).toHaveURL(`${url}/s/anna`);
    // In the same tab, only the part after the `#` changes.
    const again = page.waitForEvent('load');
    await page.evaluate((address) => {
      document.location.href = address;
    }, link);
    await again;
    await isLive(page);
    await expect(page, `${round}, in the same tab`).toHaveURL(`${url}/s/anna`);
    await page.goto('about:blank');
  }
  expect([...addresses, ...(await historyOf(page))].join(' ')).not.toContain(token);
});

/** The login ends because the server restarts with another token. */
test('reports that the login has ended', async ({ page, watch }) => {
  watch.allow(REFUSED);
  watch.allow(CONNECTION_LOST);
  const token = Server.newToken();
  let server = await Server.start({ token });
  try {
    watch.allowHost(server.url);
    const lab = new Lab(page);
    await skipFirstVisit(page);
    await page.goto(`${server.url}/#token=${token}`);
    await until('the first state', () => lab.isComplete);
    const { port } = server;
    await server.stop();
    server = await Server.start({ port, token: Server.newToken() });
    await page.getByText(LOGIN_ENDED).waitFor({ timeout: 30_000 });
    await expect(lab.button('Run')).toBeDisabled();
  } finally {
    await server.stop();
  }
});
