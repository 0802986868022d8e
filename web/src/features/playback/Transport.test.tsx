import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { fakeLab, show } from '../../lab/testingLab';
import { Transport } from './Transport';

const button = (name: string) => page.getByRole('button', { name, exact: true });

async function open() {
  const { lab, server } = fakeLab();
  show(() => (
    <>
      <PlaceNotice lab={lab} place="workspace" />
      <Transport lab={lab} />
    </>
  ));
  await expect.element(button('Run')).toBeEnabled();
  return { lab, server };
}

it('steps by a tick, and with Shift to the next control step', async () => {
  const { server } = await open();
  await button('Step').click();
  await expect.poll(() => server.command('step')?.ticks).toBe(1);
  server.state({ tick: 1, newest_tick: 1 });
  server.done();
  await button('Step').click({ modifiers: ['Shift'] });
  await expect.poll(() => server.command('step')?.ticks).toBe(31);
});

it('says quietly that the machine is at its limit, below 85 % of the speed', async () => {
  const { server } = await open();
  const achieved = page.getByTestId('achieved');
  server.state({ running: true, speed_target: 64, speed_achieved: 55 });
  await expect.element(button('Pause')).toBeVisible();
  await expect.element(achieved).toHaveTextContent('');
  server.state({ speed_achieved: 54 });
  await expect
    .element(achieved.getByText('only 54'))
    .toHaveAttribute('title', expect.stringContaining('The result of the trial is the same'));
});

it('asks for a goal when it runs without one', async () => {
  const { lab, server } = await open();
  const notice = page.getByText('No goal is set');
  await button('Run').click();
  await expect.poll(() => server.command('run')).toBeDefined();
  await expect.element(button('Run')).toHaveAttribute('aria-busy', 'true');
  server.state({ running: true });
  server.done();
  await expect.element(notice).toBeVisible();
  void lab.send('workspace', { type: 'set_goal', x_m: 0.1, y_m: -0.3 });
  await expect.element(notice).not.toBeInTheDocument();
  server.state({ running: false, goal_m: [0.1, -0.3, 0] });
  server.done();
  await expect.poll(() => lab.goal()).toBeDefined();
  await button('Run').click();
  await expect.poll(() => server.sent.at(-1)?.type).toBe('run');
  expect(lab.notices().workspace).toBeUndefined();
});
