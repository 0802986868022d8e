import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { fakeLab, show } from '../../lab/testingLab';
import { PlaybackBar } from './PlaybackBar';

const LARGEST_SEED = Number.MAX_SAFE_INTEGER;
const button = (name: string) => page.getByRole('button', { name, exact: true });

async function open() {
  const { lab, server } = fakeLab();
  show(() => (
    <>
      <PlaceNotice lab={lab} place="workspace" />
      <PlaybackBar lab={lab} above="" choices="" share="" runs="" below="" />
    </>
  ));
  await expect.element(button('Run')).toBeEnabled();
  return { lab, server };
}

it('shows a long seed as a whole', async () => {
  const { server } = await open();
  const seed = page.getByLabelText('Seed', { exact: true });
  await seed.fill(String(LARGEST_SEED));
  await userEvent.keyboard('{Enter}');
  await expect.poll(() => server.command('reset')?.seed).toBe(LARGEST_SEED);
  server.scene({ seed: LARGEST_SEED });
  const input = seed.element() as HTMLInputElement;
  input.blur();
  await expect.element(seed).toHaveValue(String(LARGEST_SEED));
  await expect.poll(() => input.scrollWidth - input.clientWidth).toBeLessThanOrEqual(0);
});

it('steps to the next control step', async () => {
  const { server } = await open();
  await button('Step ¼ s').click();
  await expect.poll(() => server.command('step')?.ticks).toBe(32);
  server.state({ tick: 32, newest_tick: 32 });
  await expect.element(page.getByTestId('tick')).toHaveTextContent('tick 32');
  await button('Step ¼ s').click();
  await expect.poll(() => server.command('step')?.ticks).toBe(31);
});

it('says quietly that the machine is at its limit, below 85 % of the speed', async () => {
  const { server } = await open();
  const achieved = page.getByTestId('achieved');
  server.state({ running: true, speed_target: 64, speed_achieved: 55 });
  await expect.element(achieved).toHaveTextContent('achieved 55.0×');
  await expect.element(achieved).not.toHaveTextContent('machine limit');
  server.state({ speed_achieved: 54 });
  const limit = achieved.getByText('machine limit');
  await expect
    .element(limit)
    .toHaveAttribute('title', expect.stringContaining('The result of the trial is the same'));
  const muted = document.createElement('span');
  muted.style.color = 'var(--ink-3)';
  document.body.append(muted);
  const color = (element: Element): string => getComputedStyle(element).color;
  expect(color(limit.element())).toBe(color(muted));
  expect(color(muted)).not.toBe(color(document.body));
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
