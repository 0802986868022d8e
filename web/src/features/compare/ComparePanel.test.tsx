import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { fakeLab, show } from '../../lab/testingLab';
import ComparePanel from './ComparePanel';

it('compares the chosen controllers, and shows why the server refuses it', async () => {
  const { lab, server } = fakeLab();
  show(() => <ComparePanel lab={lab} />);
  const start = page.getByRole('button', { name: /^Compare from/ });
  await expect.element(start).toBeEnabled();
  await page.getByLabelText('Compare RL').click();
  await start.click();
  await expect
    .poll(() => server.command('fork'))
    .toMatchObject({ tick: 0, controllers: ['errt', 'attractor'] });
  server.refuse('no_goal', 'no goal is set');
  await expect.element(page.getByText('No goal was set at that moment')).toBeVisible();
  server.hello({ role: 'viewer' });
  await expect.element(start).toBeDisabled();
});
