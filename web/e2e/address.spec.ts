// Addresses of the views and lessons, and the browser's Back, Forward and reload.

import { type Lab, expect, test } from './fixtures';

const pathOf = (lab: Lab) => new URL(lab.page.url()).pathname;

async function isAt(lab: Lab, path: string, view: string) {
  await expect.poll(() => pathOf(lab)).toBe(path);
  await expect(lab.view(view)).toHaveAttribute('aria-current', 'page');
}

test('each view has an address, for Back, Forward, reload and a link', async ({
  lab,
  openLab,
  session,
}) => {
  const { page } = lab;
  const base = new URL(session.url).pathname;
  await lab.view('Draw').click();
  await isAt(lab, `${base}/draw`, 'Draw');
  await expect(page).toHaveTitle('Draw – Ferry');
  await lab.view('Train').click();
  await isAt(lab, `${base}/train`, 'Train');
  await page.goBack();
  await isAt(lab, `${base}/draw`, 'Draw');
  await expect(page.getByLabel('Drawing', { exact: true })).toBeVisible();
  await page.goBack();
  await expect(lab.view('Lab')).toHaveAttribute('aria-current', 'page');
  await page.goForward();
  await isAt(lab, `${base}/draw`, 'Draw');
  await page.reload();
  await isAt(lab, `${base}/draw`, 'Draw');

  const other = await openLab({ url: page.url() });
  await isAt(other, `${base}/draw`, 'Draw');
  const answer = await page.request.get(`${session.url}/drawer`, {
    headers: { accept: 'text/html' },
  });
  expect(answer.status(), 'a view that does not exist').toBe(404);
});

test('a lesson has an address', async ({ lab, session }) => {
  const { page } = lab;
  const base = new URL(session.url).pathname;
  const question = page.getByRole('radiogroup', { name: /magnet/i });
  await lab.panel('Learn');
  await page.getByRole('button', { name: /^Meet the magnet/ }).click();
  await isAt(lab, `${base}/learn/magnet`, 'Lab');
  await expect(question).toBeVisible();
  // It stays open while another view is shown.
  await lab.view('Evaluate').click();
  await isAt(lab, `${base}/evaluate`, 'Evaluate');
  await lab.view('Lab').click();
  await isAt(lab, `${base}/learn/magnet`, 'Lab');
  await page.reload();
  await expect(question).toBeVisible();
  await page.getByRole('button', { name: 'All lessons' }).click();
  await isAt(lab, base, 'Lab');
  await page.goBack();
  await expect(question).toBeVisible();
  await page.goto(`${session.url}/learn/nothing`);
  await expect(page.getByText('There is no lesson “nothing”.')).toBeVisible();
});

test('the help leads to the licences of all that the page is made of', async ({ lab }) => {
  const { page } = lab;
  await lab.button('Help').click();
  await page.getByRole('link', { name: 'libraries and a font of others' }).click();
  for (const part of ['## solid-js', '## three', '## Inter (OFL-1.1)'])
    await expect(page.getByText(part)).toBeVisible();
  await page.goBack();
  await lab.live();
});
