// The list of jobs: a recovery map runs beside a training, both are shown, and each can be paused and cancelled.

import { expect, test } from './fixtures';
import { isDone, startMap } from './support/recovery';
import { TRAIN_MS, clearTrainings, reachStage, startTraining } from './support/trainings';

/** More than a training learns during this test. */
const MANY_UPDATES = 20_000;

test('lists a recovery map beside a training, pauses it and cancels the training', async ({
  lab,
}) => {
  const { page } = lab;
  const { request } = page;
  test.setTimeout(2 * TRAIN_MS);
  const { origin } = new URL(page.url());
  await clearTrainings(request, origin);
  const id = await startTraining(request, origin, 'beside', MANY_UPDATES);
  await reachStage(request, origin, id, 'learning');
  await startMap(lab, '3');

  await page.getByRole('button', { name: /^Jobs: / }).click();
  const long = page.getByRole('region', { name: 'Long jobs' }).getByRole('listitem');
  await expect(long).toContainText('Training beside');
  await expect(long).toContainText('from the API');
  await lab.button('Pause Recovery map posts').click();
  const short = page.getByRole('region', { name: 'Short jobs' }).getByRole('listitem');
  await expect(short).toContainText('paused at');
  await expect(short).toContainText('of this session');
  await lab.button('Resume Recovery map posts').click();
  await isDone(lab);
  await expect(long).toContainText('left');

  await lab.button('Cancel Training beside').click();
  await lab.button('Yes, cancel Training beside').click();
  const ended = page.getByRole('region', { name: 'Ended' });
  await expect(ended).toContainText('cancelled at');
  await lab.button('Show Recovery map posts').first().click();
  await expect(page.getByRole('group', { name: 'Jobs' })).toBeHidden();
  await clearTrainings(request, origin);
});
