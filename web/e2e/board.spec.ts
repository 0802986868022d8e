// The page of a board, for a projector: what it shows, the choice of challenge and class, new attempts, wrong names.

import type { Page } from '@playwright/test';
import { expect, test } from './fixtures';
import { violations } from './support/axe';
import { type Attempt, dataWithBoards } from './support/boards';
import { PHONE, TABLET } from './support/browser';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { Server } from './support/server';

const EARLIER = 'hard-2026-11-20';
const PROJECTOR = { width: 1280, height: 720 };
/** The board is read every three seconds, and marks what is new for ten. */
const POLL_MS = 3000;
const NEW_MS = 10_000;
const LONG = 'Wwwwwwwwwwwwwwwwwwwwwwww';
const DAY_MS = 86_400_000;

const ATTEMPTS: Attempt[] = [
  { player: 'Ada', class: '7a', tick: 1250 },
  { player: 'Bob', class: '10b', tick: 1250, walls: 2, lost_beads: 1 },
  { player: LONG, class: LONG, tick: 1875, walls: 1 },
  ...Array.from({ length: 9 }, (_, index) => ({ player: `Player ${index}`, tick: 3000 + index })),
  { player: 'Cy', class: '7a', tick: 6000 },
];

/** In UTC. Midnight may pass during a test, so there is also a board for tomorrow. */
const days = () => [0, DAY_MS].map((later) => new Date(Date.now() + later).toISOString());
const names = () => [...days().map((day) => `easy-${day.slice(0, 10)}`), EARLIER];

let server: Server;
test.beforeEach(async ({ watch }) => {
  server = await Server.start({ data: await dataWithBoards(names(), ATTEMPTS) });
  watch.allowHost(server.url);
});
test.afterEach(async ({ page }) => {
  // A page that reads its board would report that the server has gone.
  await page.goto('about:blank');
  await server.stop();
});

const rowsOf = (page: Page) => page.getByRole('table').locator('tbody').getByRole('row');
const overflow = (page: Page) =>
  page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);

/** Faults of names, sizes, contrast and headings in both themes. */
async function faultsIn(page: Page, minSidePx: number) {
  const faults = faultsOf(await controls(page), minSidePx);
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    faults.push(...(await violations(page)));
  }
  return faults;
}

test('shows the easy challenge of today, readable on every screen', async ({ page }) => {
  let sockets = 0;
  page.on('websocket', () => (sockets += 1));
  await page.setViewportSize(PROJECTOR);
  await page.goto(`${server.url}/board`);
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Easy challenge of today');
  await expect(page).toHaveTitle(/^Board · easy-\d{4}-\d\d-\d\d – Ferry$/);
  const address = page.getByRole('link', { name: `${server.url}/copy/#challenge=easy-` });
  await expect(address).toHaveAttribute('href', /#challenge=easy-/);

  await expect(page.getByRole('columnheader')).toHaveText(
    ['Place', 'Player', 'Class', 'Total', 'Time', 'Wall stops', 'Lost beads', 'When'], // prettier-ignore
  );
  const rows = rowsOf(page);
  await expect(rows).toHaveCount(ATTEMPTS.length);
  await expect(rows.nth(0).getByRole('cell')).toHaveText(
    ['1', '7a', '10.0 s', '10.0 s', '0', '0', /./], // prettier-ignore
  );
  await expect(rows.nth(1).getByRole('rowheader')).toHaveText(LONG);
  await expect(rows.nth(2).getByRole('cell')).toHaveText(
    ['3', '10b', '17.0 s', '10.0 s', '2', '1', /./], // prettier-ignore
  );

  const tenth = await rows.nth(9).boundingBox();
  expect((tenth?.y ?? NaN) + (tenth?.height ?? NaN)).toBeLessThanOrEqual(PROJECTOR.height);
  expect(await overflow(page)).toBeLessThanOrEqual(0);
  expect(await faultsIn(page, MIN_SIDE_PX.mouse)).toEqual([]);
  for (const { viewport } of [TABLET, PHONE]) {
    await page.setViewportSize(viewport);
    expect(await overflow(page), `on ${viewport.width} px`).toBeLessThanOrEqual(0);
    expect(await violations(page)).toEqual([]);
  }
  // A phone shows blocks, which must still be a table for a screen reader.
  await expect(rows.nth(0).getByRole('cell').nth(2)).toHaveText('10.0 s');
  expect(sockets).toBe(0);
  const open = await page.request.get(`${server.url}/api/sessions`);
  expect(((await open.json()) as { sessions: unknown[] }).sessions).toHaveLength(1);
});

test('offers other challenges and the classes of the board', async ({ page }) => {
  await page.goto(`${server.url}/board?class=7a`);
  const players = rowsOf(page).getByRole('rowheader');
  await expect(players).toHaveText(['Ada', 'Cy']);
  await expect(rowsOf(page).nth(1).getByRole('cell').first()).toHaveText('2');
  await page.getByLabel('Class').selectOption('10b');
  await expect(players).toHaveText(['Bob']);
  await expect(page).toHaveURL(/\/board\?class=10b$/);
  await expect(page).toHaveTitle(/ · class 10b – Ferry$/);

  await page.getByLabel('Earlier').selectOption(EARLIER);
  await expect(page.getByRole('heading', { level: 1 })).toHaveText(
    `Challenge ${EARLIER}, class 10b`,
  );
  await page.getByLabel('Class').selectOption('all');
  await expect(players).toHaveCount(ATTEMPTS.length);

  // An empty board says how to get on it.
  const challenges = page.getByRole('navigation', { name: 'Challenges' }).getByRole('link');
  await expect(challenges).toHaveText(
    ['today', 'this week'].flatMap((period) =>
      ['Easy', 'Medium', 'Hard'].map((name) => `${name} ${period}`),
    ),
  );
  const medium = page.getByRole('link', { name: 'Medium today' });
  await medium.click();
  await expect(medium).toHaveAttribute('aria-current', 'page');
  await expect(page.getByRole('heading', { level: 2 })).toHaveText(/^No attempt is on this board/);
  await expect(page.getByRole('listitem')).toHaveText([/address/, /bead/, /your name/]);
  await expect(page.getByRole('link', { name: '/copy/#challenge=medium-' })).toBeVisible();
  expect(await faultsIn(page, MIN_SIDE_PX.mouse)).toEqual([]);
  await page.goBack();
  await expect(players).toHaveCount(ATTEMPTS.length);
});

test('highlights an attempt that is new, for a while', async ({ page }) => {
  const grace = { player: 'Grace', class: '7a', score: { tick: 1300, walls: 1, lost_beads: 0 } };
  let reads = 0;
  await page.route(`**/api/challenges/${EARLIER}`, async (route) => {
    const response = await route.fetch();
    const report = (await response.json()) as { board: object[] };
    reads += 1;
    const entry = { ...grace, at: '2026-11-26T09:30:00Z', total_s: 11.4 };
    if (reads > 1) report.board.splice(1, 0, entry);
    await route.fulfill({ json: report });
  });
  // The test advances the page's timers.
  await page.clock.install();
  await page.goto(`${server.url}/board?challenge=${EARLIER}`);
  const fresh = page.locator('tr[data-new]');
  await expect(rowsOf(page)).toHaveCount(ATTEMPTS.length);
  await expect(fresh).toHaveCount(0);
  await page.clock.runFor(POLL_MS);
  await expect(fresh).toContainText('Grace');
  await expect(page.getByRole('status')).toHaveText('New: Grace, place 2, 11.4 s');
  expect(await faultsIn(page, MIN_SIDE_PX.mouse)).toEqual([]);
  await page.clock.runFor(NEW_MS);
  await expect(fresh).toHaveCount(0);
  await expect(page.getByRole('status')).toBeEmpty();
  await expect(rowsOf(page)).toHaveCount(ATTEMPTS.length + 1);
});

test('repeats what the server says about a wrong name', async ({ page, watch }) => {
  watch.allow(/404/);
  await page.goto(`${server.url}/board?challenge=simple-2026-11-26`);
  const problem = page.getByRole('alert');
  await expect(problem).toContainText('"simple-2026-11-26" is not a challenge: it must be easy');
  expect(await faultsIn(page, MIN_SIDE_PX.mouse)).toEqual([]);
  await page.getByRole('link', { name: 'Easy today' }).click();
  await expect(problem).toBeEmpty();
  await expect(rowsOf(page)).toHaveCount(ATTEMPTS.length);
});
