// The view Recordings: the list, names, and the download of recordings and input logs.

import { readFile } from 'node:fs/promises';
import { type Lab, type Session, expect, test } from './fixtures';
import { SECOND_TICKS } from './support/stepper';

/** The list is polled every three seconds. */
const LISTED_MS = 20_000;

const rowOf = (lab: Lab, { name }: Session) => lab.page.getByRole('row').filter({ hasText: name });

test('lists recordings, and downloads their files', async ({ lab, session }) => {
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.2, 0.4)[0]);
  await lab.step(4 * SECOND_TICKS);

  await lab.view('Recordings').click();
  const row = rowOf(lab, session).first();
  await expect(row).toContainText('recording now');
  await expect(row).toContainText('this session');
  await expect(row).toContainText(/\d+[.,]?\d* [kM]B/);
  await expect(row).toContainText(String(new Date().getFullYear()));

  // That of the session is chosen.
  const chosen = lab.page.getByRole('complementary', { name: 'Chosen recording' });
  const downloading = lab.page.waitForEvent('download');
  await chosen.getByRole('link', { name: `Download the Rerun file of ${session.name}` }).click();
  const download = await downloading;
  expect(download.suggestedFilename()).toMatch(new RegExp(`-${session.name}\\.rrd$`));
  const bytes = await readFile(await download.path());
  expect(bytes.subarray(0, 4).toString()).toBe('RRF2');

  const log = lab.page.waitForEvent('download');
  await chosen.getByRole('link', { name: `Download the input log of ${session.name}` }).click();
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
