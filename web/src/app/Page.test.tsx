// The whole page: what a viewer may press, keys, notices, layout.

import { describe, expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { fakeServer, show, type FakeServer } from '../lab/testingLab';
import { Page } from './Page';

const button = (name: string) => page.getByRole('button', { name, exact: true });

/** The page with a fake server. */
async function open(panels = ['camera', 'parameters', 'lower', 'aside']): Promise<FakeServer> {
  localStorage.setItem('ferry.tips', 'run,drag,goal,controller,scene');
  for (const panel of panels) localStorage.setItem(`ferry.panel.${panel}`, 'open');
  const server = fakeServer();
  show(() => <Page />);
  await expect.element(page.getByTestId('connection')).toHaveTextContent('live');
  return server;
}

it('has no control without an accessible name', async () => {
  await open();
  await expect.element(button('Run')).toBeEnabled();
  await expect.element(page.getByTestId('role')).toHaveTextContent('operator');
  await expect.element(page.getByText('Simulation, not safety-rated')).toBeVisible();
  const controls = document.querySelectorAll<HTMLInputElement>('button, input, select, canvas');
  const unnamed = [...controls].filter((one) => {
    const labels = one.labels as NodeListOf<Element> | null | undefined;
    const label = one.getAttribute('aria-label') ?? labels?.[0]?.textContent;
    // A plot is one picture; its parts have no name.
    return !(label ?? one.textContent).trim() && !one.closest('[role=img]');
  });
  expect(controls.length).toBeGreaterThan(50);
  expect(unnamed.map((one) => one.outerHTML)).toEqual([]);
});
it('keys', async () => {
  const server = await open();
  await userEvent.keyboard('.');
  await expect.poll(() => server.command('step')).toEqual({ type: 'step', ticks: 1, epoch: 1 });
  console.log(document.body.innerText.slice(0,300), innerWidth, innerHeight);
});
describe;
