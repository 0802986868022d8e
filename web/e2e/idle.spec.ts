// A page at rest asks the server for nothing: what changes comes over its one WebSocket.

import { setTimeout as delay } from 'node:timers/promises';
import { expect, test } from './fixtures';
import { DRAWING } from './support/maps';
import { until } from './support/wait';

/** The recordings are read once more after three seconds. */
const settleMs = (view: string) => (view === 'Recordings' ? 3300 : 700);
/** Longer than the pauses with which these views polled. */
const REST_MS = 5300;

const PANELS = ['Now', 'Story', 'Learn', 'Play', 'Compare', 'Recovery', 'Disturb', 'Tune'] as const;

test('a page at rest makes no request, in any view, after each panel was open', async ({
  lab,
  openLab,
  server,
}) => {
  const viewer = await openLab();
  const { page } = viewer;
  const requests: string[] = [];
  const sockets: string[] = [];
  page.on('request', (request) => requests.push(request.url()));
  page.on('websocket', (socket) => sockets.push(socket.url()));
  await page.reload();
  await viewer.isConnection('live');
  await expect(page.getByRole('tab')).toHaveText(['Now', 'Story', 'Learn', 'Play', 'Test', 'Tune']);
  for (const panel of PANELS) await viewer.panel(panel);
  for (const name of ['Layers', 'Layers', 'Plots']) await viewer.button(name).click();
  /** Waits for the requests of what was opened. Returns the number of all so far. */
  const settled = async (pause_ms: number) => {
    let count = -1;
    await until('no further request', async () => {
      const before = count;
      count = requests.length;
      await delay(pause_ms);
      return before === requests.length;
    });
    return count;
  };
  for (const name of ['Draw', 'Train', 'Recordings', 'Evaluate', 'Lab']) {
    await page
      .getByRole('navigation', { name: 'Views' })
      .getByRole('link', { name, exact: true })
      .click();
    const count = await settled(settleMs(name));
    await delay(REST_MS);
    expect(requests.slice(count), name).toEqual([]);
  }
  // What another browser changes is shown all the same, with the drawings of the maps as pictures.
  await viewer.setUp();
  await page.getByRole('radiogroup', { name: 'Map' }).waitFor();
  const before = await settled(settleMs('Lab'));
  const added = await lab.page.request.post(`${server.url}/api/maps?name=rest`, {
    data: DRAWING,
    headers: { 'content-type': 'image/svg+xml' },
  });
  const { name } = (await added.json()) as { name: string };
  const maps = page.getByRole('radiogroup', { name: 'Map' });
  const choice = maps.getByRole('radio', { name, exact: true });
  await expect(choice).toHaveCount(1);
  expect((await lab.page.request.delete(`${server.url}/api/maps/${name}`)).status()).toBe(204);
  await expect(choice).toHaveCount(0);
  const drawing = `${server.url}/api/maps/${name}`;
  expect(requests.slice(before).filter((url) => url !== drawing)).toEqual([]);
  expect(sockets.map((url) => new URL(url).pathname.split('/').at(-1))).toEqual(['live']);
  await page.close();
});
