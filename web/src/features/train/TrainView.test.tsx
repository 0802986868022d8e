import { Show, createSignal } from 'solid-js';
import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { trainingOf } from '../../lab/testing';
import { type Answers, fakeLab, refusal, show } from '../../lab/testingLab';
import { CELLS, frameOf, pointOf } from './testing';
import TrainView from './TrainView';

const button = (name: string | RegExp) => page.getByRole('button', { name });
const name = page.getByLabelText('Policy name');
const submit = button(/^Train /);
const settings = page.getByText(/^Settings/);

it('explains itself, and refuses a wrong name or setting at its field', async () => {
  const { lab, server } = fakeLab({
    'POST /api/trainings': () => refusal('name: a shipped policy is called general', 'name'),
  });
  const [isOpen, setOpen] = createSignal(true);
  show(() => (
    <Show when={isOpen()}>
      <TrainView lab={lab} onEvaluate={() => undefined} />
    </Show>
  ));
  await expect
    .element(page.getByRole('region', { name: 'What happens here' }))
    .toHaveTextContent('Press Train');
  const refused = (): string[] =>
    [...document.querySelectorAll('.form-row > .refusal')]
      .map((one) => one.textContent)
      .filter((text) => text !== '');

  await name.fill('My policy');
  await submit.click();
  await expect.element(name).toHaveAttribute('aria-invalid', 'true');
  await expect.element(name).toHaveFocus();
  expect(refused()).toEqual([expect.stringContaining('a to z')]);
  await expect.element(page.getByText('Policy name is wrong.')).toBeVisible();
  expect(server.requests).not.toContain('POST /api/trainings');

  // The server knows the names that are taken.
  await name.fill('general');
  expect(refused()).toEqual([]);
  await submit.click();
  await expect.poll(refused).toEqual(['name: a shipped policy is called general']);

  // A wrong field in the closed settings is opened.
  await name.fill('mine');
  await settings.click();
  const discount = page.getByLabelText('Discount');
  await discount.fill('2');
  await settings.click();
  await expect.element(discount).not.toBeVisible();
  await submit.click();
  await expect.element(discount).toHaveFocus();
  await expect.element(page.getByText('Discount is wrong.')).toBeVisible();
  await button('Reset the settings').click();
  await expect.poll(refused).toEqual([]);

  // The form stays while another view is open.
  await name.fill('general');
  setOpen(false);
  await expect.element(name).not.toBeInTheDocument();
  setOpen(true);
  await expect.element(name).toHaveValue('general');

  // Only the button starts a training, and only for the operator.
  const requests = server.requests.length;
  await name.click();
  await userEvent.keyboard('{Enter}');
  server.hello({ role: 'viewer' });
  await expect.element(submit).toBeDisabled();
  expect(server.requests.slice(requests)).not.toContain('POST /api/trainings');
});

it('shows two trainings beside each other, and what can be done with each', async () => {
  const one = trainingOf({ id: 'training-1', frames: 2 });
  const two = trainingOf({
    id: 'training-2',
    stage: 'done',
    frames: 1,
    policy: 'two@0123456789abcdef',
    query: { ...one.query, name: 'two' },
  });
  const answersOf = (id: string): Answers => ({
    [`GET /api/trainings/${id}/cells`]: () => CELLS,
    [`GET /api/trainings/${id}/frames/0`]: () => frameOf(100),
    [`GET /api/trainings/${id}/frames/1`]: () => frameOf(200),
    [`GET /api/trainings/${id}`]: () => ({ ...two, id, curve: [pointOf(100)] }),
  });
  const { lab, server } = fakeLab({
    'GET /api/maps/posts': () => refusal('no map'),
    ...answersOf(one.id),
    ...answersOf(two.id),
    'POST /api/trainings/training-1/pause': () => refusal('too late'),
  });
  server.lists({ trainings: [one, two], policies: [] });
  show(() => <TrainView lab={lab} onEvaluate={() => undefined} />);
  const names = () =>
    [...document.querySelectorAll('.training-choose strong')].map((name) => name.textContent);
  await expect.poll(names).toEqual(['two', 'my-posts']);
  await expect.element(page.getByText('policy deleted')).toBeVisible();
  await expect.element(button('Remove two from the list')).toBeEnabled();
  // The newest one is shown.
  await expect.element(page.getByTestId('train-update')).toHaveTextContent('after 100 updates');

  await button('Compare with my-posts').click();
  await expect.element(button('Cancel my-posts')).toBeEnabled();
  await expect.poll(() => page.getByTestId('train-update').all().length).toBe(2);
  await expect
    .element(page.getByTestId('train-update').nth(1))
    .toHaveTextContent('after 200 updates');
  await button('Curves').click();
  await expect
    .element(page.getByRole('img', { name: /^Loss over the updates/ }))
    .toHaveAccessibleName(/After 100 updates: my-posts 0\.010\.?$/);

  // A chosen cell needs all value maps.
  const plan = page.getByRole('application', { name: /values of my-posts$/ });
  (plan.element() as HTMLElement).focus();
  await userEvent.keyboard('{ArrowLeft}');
  await expect.element(page.getByRole('img', { name: /2 value maps of 2$/ })).toBeInTheDocument();

  await button('Pause my-posts').click();
  await expect.element(page.getByText('too late')).toBeVisible();
  server.hello({ role: 'viewer' });
  await expect.element(button('Pause my-posts')).toBeDisabled();
  await expect
    .element(button('Pause my-posts'))
    .toHaveAttribute('title', 'Only the operator can do this');
});
