// A server that answers late, and one that refuses everything: each control waits, and then shows what holds.

import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { fakeServer, show, type FakeServer } from '../lab/testingLab';
import { Page } from './Page';

const LATE_MS = 2000;

const button = (name: string) => page.getByRole('button', { name, exact: true });
const select = (name: string) => page.getByLabelText(name, { exact: true });
const map = (name: string) => page.getByRole('radio', { name, exact: true });
const errt = page.getByRole('radio', { name: 'ERRT' });
const rl = page.getByRole('radio', { name: 'RL' });
const busy = (): string[] =>
  [...document.querySelectorAll('[aria-busy=true]')].map(({ outerHTML }) => outerHTML);
const notices = (): string[] =>
  [...document.querySelectorAll('.notice[data-tone=error]')].map(
    (one) => one.closest('.notices')?.getAttribute('data-place') ?? '',
  );

/** Uses each control whose command the server answers; returns the server and the number of controls. */
async function used(): Promise<{ server: FakeServer; controls: number }> {
  localStorage.setItem('ferry.visit', 'done');
  localStorage.setItem('ferry.tips', 'run,drag,goal,controller,scene');
  const server = fakeServer();
  show(() => <Page />);
  await expect.element(page.getByTestId('connection')).toHaveAttribute('data-link', 'live');
  server.lists({ maps: ['posts', 'colon'] });
  server.state({ controller: 'rl', goal_m: [0.1, -0.3, 0] });
  await expect.element(rl).toBeChecked();
  await page.getByTitle('Set up: map, preset, seed').click();
  await button('Run').click();
  await button('Step').click();
  await button('Reset').click();
  await button('New seed').click();
  await button('Clear goal').click();
  await select('Speed').selectOptions('2×');
  await map('colon').click();
  await errt.click();
  return { server, controls: 8 };
}

it('each control shows the choice and waits while the server answers late', async () => {
  const { server, controls } = await used();
  await new Promise((done) => setTimeout(done, LATE_MS));
  expect(busy(), busy().join(', ')).toHaveLength(controls);
  await expect.element(errt).toBeChecked();
  await expect.element(select('Speed')).toHaveDisplayValue('2×');
  await expect.element(map('colon')).toBeChecked();
  server.state({ speed_target: 2, running: true });
  server.load();
  server.state({ controller: 'errt' });
  server.done();
  await expect.poll(busy).toEqual([]);
  await expect.element(errt).toBeChecked();
  await expect.element(select('Speed')).toHaveDisplayValue('2×');
  await expect.element(map('colon')).toBeChecked();
  await expect.element(button('Pause')).toBeVisible();
  expect(notices()).toEqual([]);
});

it('each control shows the old value again when the server refuses, and the panel says why', async () => {
  const { server, controls } = await used();
  expect(busy(), busy().join(', ')).toHaveLength(controls);
  for (let count = 0; count < controls; count++) server.refuse('busy', '');
  await expect.poll(busy).toEqual([]);
  await expect.element(rl).toBeChecked();
  await expect.element(errt).not.toBeChecked();
  await expect.element(select('Speed')).toHaveDisplayValue('1×');
  await expect.element(map('posts')).toBeChecked();
  await expect.element(button('Run')).toBeVisible();
  expect(notices().sort()).toEqual(['controller', 'transport', 'workspace']);
  // It stays until it is read.
  await page.getByRole('button', { name: 'Dismiss', exact: true }).first().click();
  await expect.poll(() => notices().length).toBe(2);
});
