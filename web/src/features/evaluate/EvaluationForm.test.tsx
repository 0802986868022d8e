import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import type { EvaluationQuery } from '../../net/protocol.gen';
import { change } from './draft';
import { EvaluationForm } from './EvaluationForm';
import { PAPERS } from './request';
import { summaryOf } from './testing';

const run = page.getByRole('button', { name: 'Run' });
const box = (name: string) => page.getByRole('checkbox', { name, exact: true });

async function open(answer: (query: EvaluationQuery) => unknown) {
  change(PAPERS);
  const { lab, server } = fakeLab({
    'POST /api/evaluations': (body) => answer(JSON.parse(body) as EvaluationQuery),
  });
  const started: string[] = [];
  show(() => <EvaluationForm lab={lab} onStarted={(id) => started.push(id)} />);
  server.lists({ maps: ['posts', 'colon'] });
  await expect.element(box('posts')).toBeVisible();
  await expect.element(run).toBeEnabled();
  return { server, started };
}

it('marks the field that the server refuses', async () => {
  const { server, started } = await open(({ episodes }) =>
    refusal(`episodes is ${episodes}, which makes 30000 trials`, 'episodes'),
  );
  const episodes = page.getByLabelText('Episodes per cell');
  // The range is known without the server.
  await episodes.fill('0');
  await userEvent.keyboard('{Enter}');
  await expect
    .element(episodes)
    .toHaveAccessibleDescription('“0” must be a whole number from 1 to 1000.');
  expect(server.requests).not.toContain('POST /api/evaluations');
  await episodes.fill('1000');
  await userEvent.keyboard('{Enter}');
  await expect.element(episodes).toHaveAttribute('aria-invalid', 'true');
  await expect
    .element(episodes)
    .toHaveAccessibleDescription('episodes is 1000, which makes 30000 trials');
  expect(started).toEqual([]);
  // A changed field loses its refusal.
  await episodes.fill('1');
  await expect.element(episodes).toHaveAttribute('aria-invalid', 'false');
});

it('names a range of a varied parameter that is refused', async () => {
  const { started } = await open(({ vary }) =>
    refusal(`friction is 1.5 of ${vary.length} varied, it must be 0 to 1`, 'vary[0]'),
  );
  await page.getByLabelText('Vary a parameter').selectOptions('Friction μ');
  await page.getByLabelText('To', { exact: true }).fill('3');
  await run.click();
  await expect
    .element(page.getByRole('group', { name: 'Vary' }))
    .toHaveAccessibleDescription('friction is 1.5 of 1 varied, it must be 0 to 1');
  expect(started).toEqual([]);
});

it('counts cells and episodes, and starts what is chosen', async () => {
  let query: EvaluationQuery | undefined;
  const { server, started } = await open((body) => {
    query = body;
    return summaryOf({ id: 'evaluation-1' });
  });
  for (const name of ['RL', 'Attractor', 'colon', '3']) await box(name).click();
  await box('posts').click();
  await page.getByLabelText('Episodes per cell').fill('4');
  await expect
    .element(page.getByTestId('evaluation-scope'))
    .toHaveTextContent('1 cell, 4 episodes');
  server.hello({ role: 'viewer' });
  await expect.element(run).toBeDisabled();
  server.hello();
  await run.click();
  await expect.poll(() => started).toEqual(['evaluation-1']);
  expect(query).toMatchObject({ controllers: ['attractor'], maps: ['posts'], episodes: 4 });
});
