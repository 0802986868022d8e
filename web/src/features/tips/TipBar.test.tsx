import { createSignal } from 'solid-js';
import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { phaseOf } from '../../lab/testingFacts';
import { fakeLab, show } from '../../lab/testingLab';
import { TipBar } from './TipBar';

const tip = page.getByRole('status');

function open() {
  const { lab, server } = fakeLab();
  const [scene, setScene] = createSignal(false);
  show(() => <TipBar lab={lab} scene={scene()} />);
  return { server, setScene };
}

it('shows one tip at a time, and none twice', async () => {
  const { server, setScene } = open();
  // Without a goal, nothing would move.
  await expect.element(tip).toHaveTextContent('Click a free place to set the goal.');
  server.state({ goal_m: [0.1, -0.3, 0] });
  await expect.element(tip).toHaveTextContent('Press Run');
  server.state({ running: true });
  await expect.element(tip).toHaveTextContent('Drag the bead');
  // A later tip can be done first.
  server.state({ controller: 'errt' });
  await expect.poll(() => localStorage.getItem('ferry.tips')).toContain('controller');
  await expect.element(tip).toHaveTextContent('Drag the bead');
  server.state({ disturbances: 1 });
  await expect.element(tip).toHaveTextContent('Choose 3-D');
  setScene(true);
  await expect.element(tip).not.toBeInTheDocument();
  setScene(false);
  await expect.element(tip).not.toBeInTheDocument();
});

it('goes on with the next tip after a reload', async () => {
  localStorage.setItem('ferry.tips', 'run,drag,goal,controller');
  open();
  await expect.element(tip).toHaveTextContent('Choose 3-D');
});

it('does not ask for what is so already', async () => {
  const { server } = open();
  server.hello({ role: 'viewer' });
  server.state({ goal_m: [0.1, -0.3, 0], running: true });
  await expect.element(tip).not.toBeInTheDocument();
  server.hello();
  await expect.element(tip).toHaveTextContent('Drag the bead');
  server.state({ phase: phaseOf('delivered') });
  await expect.element(tip).toHaveTextContent('Choose another controller');
  await page.getByRole('button', { name: 'Compare' }).click();
  await expect.element(tip).toHaveTextContent('Choose 3-D');
});

it('skips all tips', async () => {
  open();
  await expect.element(tip).toBeVisible();
  (page.getByRole('button', { name: 'Skip tips' }).element() as HTMLElement).focus();
  await userEvent.keyboard('{Enter}');
  await expect.element(tip).not.toBeInTheDocument();
  expect(localStorage.getItem('ferry.tips')).toBe('run,drag,goal,controller,scene');
});
