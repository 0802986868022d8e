import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { fakeLab, show } from '../../lab/testingLab';
import { Handover } from './Handover';
import { Watching } from './Watching';

async function open() {
  const { lab, server } = fakeLab();
  show(() => (
    <>
      <Handover lab={lab} />
      <Watching lab={lab}>{undefined}</Watching>
    </>
  ));
  await expect.poll(lab.canOperate).toBe(true);
  return { lab, server, said: () => lab.notices().session?.text };
}
const alert = page.getByRole('alert');

it('counts down for the operator, who keeps control or gives it', async () => {
  const { server } = await open();
  server.hello({ asked: true, answer_within_s: 29.6 });
  await expect.element(alert).toHaveTextContent(/gets it in 30 s/);
  await expect.element(alert).toHaveTextContent(/gets it in 29 s/);
  // A command of the operator begins the time again.
  server.hello({ asked: true, answer_within_s: 30 });
  await expect.element(alert).toHaveTextContent(/gets it in 30 s/);
  await page.getByRole('button', { name: 'Keep' }).click();
  await page.getByRole('button', { name: 'Give control' }).click();
  await expect
    .poll(() => server.sent.map(({ type }) => type))
    .toEqual(['keep_control', 'release_control']);
});

it('tells an operator who did nothing that control is gone, and not one who gave it', async () => {
  const { server, said } = await open();
  server.hello({ asked: true, answer_within_s: 20 });
  await expect.element(alert).toHaveTextContent(/20 s/);
  server.hello({ role: 'viewer' });
  await expect.element(alert).not.toHaveTextContent(/gets it/);
  expect(said()).toBeUndefined();
  server.hello({ asked: true, answer_within_s: 0.4 });
  await expect.element(alert).toHaveTextContent(/[01] s/);
  server.hello({ role: 'viewer' });
  await expect.poll(said).toMatch(/nothing was done here/);
});

it('tells who asked how the request stands and ends', async () => {
  const { server, said } = await open();
  server.hello({ role: 'viewer' });
  await page.getByRole('button', { name: 'Take control' }).click();
  server.hello({ role: 'viewer', asks: true, ahead: 2, answer_within_s: 10 });
  await expect.element(page.getByText('2 requests before yours.')).toBeVisible();
  server.hello({ role: 'viewer', asks: true, answer_within_s: 30 });
  await expect.element(page.getByText(/It is yours in 30 s/)).toBeVisible();
  server.hello({ role: 'viewer' });
  await expect.poll(said).toBe('The operator keeps control. You can ask again in a minute.');
  server.hello({ role: 'viewer', asks: true, answer_within_s: 30 });
  await page.getByRole('button', { name: 'Withdraw' }).click();
  await expect
    .poll(() => server.sent.map(({ type }) => type))
    .toEqual(['take_control', 'release_control']);
});
