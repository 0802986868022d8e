import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import type { RecoveryQuery } from '../../net/protocol.gen';
import { RecoveryPanel } from './RecoveryPanel';

it('sends what is chosen, and shows why the server refuses it', async () => {
  let query: RecoveryQuery | undefined;
  const { lab, server } = fakeLab({
    'GET /api/recoveries': () => ({ recoveries: [] }),
    'POST /api/recoveries': (body) => {
      query = JSON.parse(body) as RecoveryQuery;
      return refusal(query.grid < 4 ? 'grid is 3, it must be 4 to 96' : 'no goal is set');
    },
  });
  show(() => (
    <RecoveryPanel lab={lab} theme={() => 'dark'} tools={document.createElement('div')} />
  ));
  const start = page.getByRole('button', { name: /^Map recovery from/ });
  const refused = page.getByText(/no goal is set|it must be/);
  await expect.element(start).toBeEnabled();
  server.state({ tick: 250, newest_tick: 250, sim_time_s: 2 });
  await expect.element(start).toHaveTextContent('Map recovery from 2.0 s');
  await start.click();
  await expect.element(refused).toHaveTextContent('no goal is set');
  expect(query).toMatchObject({ session: 'main', tick: 250, kind: 'place', grid: 24 });

  await page.getByLabelText('Columns').fill('3');
  await page.getByLabelText('Try RL').click();
  await start.click();
  await expect.element(refused).toHaveTextContent('grid is 3, it must be 4 to 96');
  expect(query).toMatchObject({ grid: 3, controllers: ['errt', 'attractor'] });

  for (const name of ['Try ERRT', 'Try Attractor']) await page.getByLabelText(name).click();
  await expect.element(start).toBeDisabled();
});
