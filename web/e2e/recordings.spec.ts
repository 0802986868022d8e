// The view Recordings: the list, and the download of recordings and input logs.

import { readFile } from 'node:fs/promises';
import { expect, test } from './fixtures';
import { until } from './support/wait';

test('lists recordings, and downloads their files', async ({ lab, session }) => {
  await lab.reset({ speed: '8' });
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.2, 0.4)[0]);
  await lab.run();
  await until('four seconds', () => lab.state.sim_time_s > 4);
  await lab.pause();

  await lab.view('Recordings').click();
  const row = lab.page.getByRole('row').filter({ hasText: session.name }).first();
  await expect(row).toContainText('recording now');
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
