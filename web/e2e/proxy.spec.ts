// The page below a path, as a proxy has it.

import { expect, test } from './fixtures';
import { Server } from './support/server';

test('everything that a page below a path asks for is below that path', async ({
  openLab,
  watch,
}) => {
  const server = await Server.start({ basePath: '/ferry' });
  watch.allowHost(server.url);
  const lab = await openLab({ url: `${server.url}/ferry/s/anna` });
  const { page } = lab;
  const asked: string[] = [];
  page.context().on('request', (request) => asked.push(new URL(request.url()).pathname));
  await page.reload();
  await expect(page.getByTestId('connection')).toHaveAttribute('data-link', 'live');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await lab.view('Recordings').click();
  await page.getByRole('link', { name: 'Download the Rerun file of anna' }).waitFor();
  for (const link of await page.getByRole('link').all()) {
    expect(await link.getAttribute('href')).toMatch(/^(\/ferry\/|\?|#)/);
  }
  await page.goto(`${server.url}/ferry/board`);
  await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
  expect(asked.length).toBeGreaterThan(10);
  expect(asked.filter((path) => !path.startsWith('/ferry/'))).toEqual([]);
  await server.stop();
});
