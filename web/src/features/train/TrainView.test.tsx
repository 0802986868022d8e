import { Show, createSignal } from 'solid-js';
import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import { TrainView } from './TrainView';

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
      <TrainView
        lab={lab}
        theme={() => 'dark'}
        onLaboratory={() => undefined}
        onEvaluate={() => undefined}
      />
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
  await expect.poll(refused).toEqual(['a shipped policy is called general']);

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
