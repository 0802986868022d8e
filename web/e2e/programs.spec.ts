// A program outside of Ferry: it appears in the page, carries the bead, and is missed when it is gone.

import type { Page } from '@playwright/test';
import { expect, test } from './fixtures';
import { SECOND_TICKS } from './support/stepper';
import { must, until } from './support/wait';

/** Jobs have a low priority, and other tests run at the same time. */
const RUN_MS = 90_000;

/** Connects a program that goes straight to the goal; returns what disconnects it. */
async function connect(page: Page, name: string): Promise<() => Promise<void>> {
  await page.evaluate(async (program) => {
    const address = `${location.origin.replace('http', 'ws')}/api/controllers/${program}?protocol=1`;
    const socket = new WebSocket(address);
    socket.addEventListener('message', ({ data }: MessageEvent<unknown>) => {
      if (typeof data !== 'string') return;
      const asked = JSON.parse(data) as { type: string; request: number; goal_m: number[] };
      if (asked.type !== 'observe') return;
      socket.send(JSON.stringify({ type: 'act', request: asked.request, target_m: asked.goal_m }));
    });
    await new Promise((resolve) => {
      socket.addEventListener('open', resolve);
    });
    Object.assign(window, { programSocket: socket });
  }, name);
  return () =>
    page.evaluate(() => {
      (window as unknown as { programSocket: WebSocket }).programSocket.close();
    });
}

test('a program appears, carries the bead, and is missed when it is gone', async ({
  openLab,
  browser,
}) => {
  const lab = await openLab();
  const program = lab.page.getByRole('radio', { name: 'straight' });
  await expect(program).toHaveCount(0);
  // Another browser is the program, so that this one can be watched.
  const other = await browser.newPage();
  await other.goto(new URL('/board', lab.page.url()).href);
  const disconnect = await connect(other, 'straight');
  await expect(program).toBeVisible();

  await lab.map('open');
  const start = await lab.bead();
  await lab.click(must(lab.freePoints(start, 0.1, 0.15).at(-1), 'a goal'));
  await program.check();
  await until('the choice', () => lab.state.controller === 'program');
  expect(lab.state.program?.name).toBe('straight');
  await lab.deliver();
  await expect(lab.page.getByTestId('program-standing')).toHaveText(/^straight answers in \d+ ms/);

  // Compared with the others from here, and evaluated beside them.
  await lab.panel('Compare');
  await expect(lab.page.getByLabel('Compare straight')).toBeChecked();
  await lab.page.getByLabel('Compare RL').uncheck();
  await lab.page.getByRole('button', { name: /^Compare from/ }).click();
  const compared = lab.page.getByRole('row', { name: /^straight/ });
  await expect(compared).toContainText('delivered', { timeout: RUN_MS });
  await lab.view('Evaluate').click();
  const form = lab.page.getByRole('complementary', { name: 'New evaluation' });
  await form.getByLabel('straight', { exact: true }).check();
  for (const other of ['RL', 'colon', '3']) await form.getByLabel(other, { exact: true }).uncheck();
  await form.getByLabel('open', { exact: true }).check();
  await form.getByLabel('Episodes per cell').fill('2');
  await expect(form.getByTestId('evaluation-scope')).toContainText('1 cell, 2 episodes');
  await form.getByRole('button', { name: 'Run' }).click();
  // An earlier evaluation on this server may be shown until this one is.
  const row = lab.page.getByTestId('evaluation-row').filter({ hasText: 'straight' });
  await expect(row).toContainText('2/2', { timeout: RUN_MS });
  await lab.view('Lab').click();
  await lab.panel('Now');

  await disconnect();
  await lab.click(must(lab.freePoints(await lab.bead(), 0.1, 0.15).at(-1), 'another goal'));
  await expect(lab.page.getByTestId('program-standing')).toHaveText(
    'straight is not connected: the arm holds until it is.',
  );
  await lab.step(SECOND_TICKS);
  await until(
    'the refusal',
    () => lab.state.refusal?.text === 'the program: straight is not connected',
  );
  // It stays in the list while it is selected.
  await expect(program).toBeChecked();
  await lab.page.getByRole('radio', { name: 'ERRT' }).check();
  await expect(program).toHaveCount(0);
  await lab.deliver(2);
  await other.close();
});
