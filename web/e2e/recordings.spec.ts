// The view Recordings: the list, names and titles, deletion, and the download of recordings and input logs.

import { readFile } from 'node:fs/promises';
import { PHONE } from './support/browser';
import { type Lab, type Session, expect, test } from './fixtures';
import { SECOND_TICKS } from './support/stepper';

/** The list is polled every three seconds. */
const LISTED_MS = 20_000;

/** Opens a session and ends it, so that its recording is finished. */
async function record({ name, url }: Session) {
  expect((await fetch(url)).status).toBe(200);
  const ended = await fetch(new URL(`/api/sessions/${name}`, url), { method: 'DELETE' });
  expect(ended.status).toBe(204);
}

const rowOf = (lab: Lab, { name }: Session) =>
  lab.page
    .getByRole('row')
    .filter({ has: lab.page.getByRole('button', { name: `Open ${name},` }) });

test('lists recordings, and downloads their files', async ({ lab, session }) => {
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.2, 0.4)[0]);
  await lab.step(4 * SECOND_TICKS);

  await lab.view('Recordings').click();
  const row = lab.page.getByRole('row').filter({ hasText: session.name }).first();
  await expect(row).toContainText('recording now');
  await expect(row).toContainText('this session');
  await expect(row).toContainText(/\d+[.,]?\d* [kM]B/);
  await expect(row).toContainText(String(new Date().getFullYear()));

  const downloading = lab.page.waitForEvent('download');
  await row.getByRole('link', { name: `Download ${session.name}` }).click();
  const download = await downloading;
  expect(download.suggestedFilename()).toMatch(new RegExp(`-${session.name}\\.rrd$`));
  const bytes = await readFile(await download.path());
  expect(bytes.subarray(0, 4).toString()).toBe('RRF2');

  const log = lab.page.waitForEvent('download');
  await row.getByRole('link', { name: `Download the input log of ${session.name}` }).click();
  const logged = await readFile(await (await log).path());
  expect(logged.subarray(0, 8).toString()).toBe('ferrylog');
});

test('a recording has the name of what happened in it', async ({ lab, session }) => {
  await lab.reset();
  await lab.controller('Attractor');
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.08, 0.2)[0]);
  await lab.deliver();
  await lab.view('Recordings').click();
  const row = rowOf(lab, session);
  await expect(row).toContainText('Posts, Attractor: 1 delivered', { timeout: LISTED_MS });
  await expect(row.getByRole('cell').first()).toHaveText(/^\d+:\d\d$/);
  await expect(row).toContainText(session.name);
});

test('names a recording, also on a phone', async ({ lab, newSession, watch }) => {
  const { page } = lab;
  const session = newSession();
  await record(session);
  await page.setViewportSize(PHONE.viewport);
  await lab.view('Recordings').click();
  const row = rowOf(lab, session);
  await expect(row).toContainText('Not run');
  const renamer = row.getByRole('button', { name: /^Rename / });
  const field = row.getByRole('textbox', { name: `Title of ${session.name}` });
  const rename = async (title: string, key: string) => {
    await renamer.press('Enter');
    await expect(field).toBeFocused();
    await field.fill(title);
    await field.press(key);
  };
  await rename(' Second try ', 'Enter');
  await expect(renamer, 'the focus returns to the button').toBeFocused();
  await expect(row.getByRole('rowheader')).toContainText('Second try');
  await expect(row.getByRole('rowheader')).not.toContainText('Not run');

  await rename('Third try', 'Escape');
  await expect(renamer).toBeFocused();
  await expect(row.getByRole('rowheader')).toContainText('Second try');

  // The server's reason is shown, and what was typed stays.
  watch.allow(/status of 422/);
  await rename('x'.repeat(81), 'Enter');
  await expect(page.getByText('the title has 81 characters, the limit is 80')).toBeVisible();
  await expect(field).toHaveValue('x'.repeat(81));
  await row.getByRole('button', { name: 'Cancel' }).click();
  expect(
    await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth),
    'the page scrolls horizontally',
  ).toBe(0);

  await page.reload();
  await lab.live();
  await lab.view('Recordings').click();
  await expect(row.getByRole('rowheader')).toContainText('Second try');
  await rename('', 'Enter');
  await expect(row.getByRole('rowheader')).toContainText('Not run');
});

test('deletes a recording after a question', async ({ lab, session, newSession, server }) => {
  const [kept, deleted, newest] = [newSession(), newSession(), newSession()];
  // The newest is first in the list, so the deleted one is between the others.
  await record(kept);
  await record(deleted);
  await record(newest);
  await lab.view('Recordings').click();
  const row = rowOf(lab, deleted);
  const opener = row.getByRole('button', { name: /^Delete / });
  await opener.press('Enter');
  const question = row.getByRole('group', { name: `Delete ${deleted.name}` });
  const keep = question.getByRole('button', { name: /^Keep / });
  await expect(keep).toBeFocused();
  await keep.press('Enter');
  await expect(question).toHaveCount(0);
  await expect(opener).toBeFocused();
  await opener.press('Enter');
  await keep.press('Escape');
  await expect(opener).toBeFocused();

  await opener.press('Enter');
  await question.getByRole('button', { name: /^Yes, / }).press('Enter');
  await expect(row).toHaveCount(0);
  await expect(
    rowOf(lab, kept).getByRole('button', { name: /^Open / }),
    'the next row gets the focus',
  ).toBeFocused();
  const { recordings } = (await (await fetch(`${server.url}/api/recordings`)).json()) as {
    recordings: { session: string | null }[];
  };
  const sessions = recordings.map((one) => one.session);
  expect(sessions).toContain(kept.name);
  expect(sessions).not.toContain(deleted.name);
  // What is being written cannot be deleted.
  const live = rowOf(lab, session);
  await expect(live.getByRole('button', { name: /^Rename / })).toBeVisible();
  await expect(live.getByRole('button', { name: /^Delete / })).toHaveCount(0);
});
