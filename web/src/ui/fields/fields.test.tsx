import { createSignal } from 'solid-js';
import { render } from 'solid-js/web';
import { afterEach, expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { CheckField, ChoiceField, FlagField, NumberField, TextField } from './fields';
import { Form } from './Form';

let close: (() => void) | undefined;
afterEach(() => {
  close?.();
  document.body.innerHTML = '';
});

class Refused extends Error {
  constructor(
    text: string,
    readonly field?: string,
  ) {
    super(text);
  }
}

/** A form with each kind of field. */
function open(send: () => unknown) {
  close = render(() => {
    const [grid, setGrid] = createSignal('4');
    const [name, setName] = createSignal('mine');
    const [chosen, setChosen] = createSignal<string[]>(['a']);
    const [kind, setKind] = createSignal('place');
    const [isFull, setFull] = createSignal(false);
    return (
      <Form class="" send={send} button="Send" disabled={false}>
        <details>
          <summary>More</summary>
          <NumberField
            name="grid"
            label="Columns"
            unit="cm"
            help="Of the finest grid."
            min={4}
            max={96}
            isWhole
            value={grid()}
            onInput={setGrid}
          />
        </details>
        <TextField name="name" label="Name" value={name()} onInput={setName} />
        <CheckField
          name="controllers"
          also={['program']}
          label="Controllers"
          missing="Choose one."
          all={['a', 'b']}
          value={chosen()}
          onChoose={setChosen}
        />
        <ChoiceField
          name="kind"
          label="Kind"
          value={kind()}
          options={[
            ['place', 'put'],
            ['push', 'push'],
          ]}
          onChoose={setKind}
        />
        <FlagField name="full" label="Full" value={isFull()} onChoose={setFull} />
      </Form>
    );
  }, document.body);
}

const button = page.getByRole('button', { name: 'Send' });
const columns = page.getByRole('spinbutton', { name: 'Columns' });
const name = page.getByRole('textbox', { name: 'Name' });
const box = page.getByRole('checkbox', { name: 'a', exact: true });

it('finds what is wrong before it sends, and opens the part that has it', async () => {
  let sent = 0;
  open(() => (sent += 1));
  await page.getByText('More').click();
  await columns.fill('3');
  await page.getByText('More').click();
  await button.click();
  await expect.element(columns).toHaveFocus();
  await expect
    .element(columns)
    .toHaveAccessibleDescription('“3” must be a whole number from 4 to 96.');
  await expect.element(page.getByText('Columns is wrong.')).toBeVisible();
  await box.click();
  await button.click();
  await expect.element(page.getByText('2 fields are wrong.')).toBeVisible();
  await expect
    .element(page.getByRole('group', { name: 'Controllers' }))
    .toHaveAccessibleDescription('Choose one.');
  expect(sent).toBe(0);
  await columns.fill('5');
  await box.click();
  await expect.element(columns).toBeValid();
  await expect.element(columns).toHaveAccessibleDescription('cm Of the finest grid.');
  await button.click();
  expect(sent).toBe(1);
});

it.each([
  ['name', name],
  ['settings.name', name],
  ['controllers[1]', box],
  ['program', box],
  ['kind', page.getByRole('combobox')],
  ['full', page.getByRole('checkbox', { name: 'Full' })],
] as const)('shows a refusal of %s at its field', async (field, input) => {
  open(() => Promise.reject(new Refused('taken', field)));
  await button.click();
  await expect.element(input).toHaveAttribute('aria-invalid', 'true');
  await expect.element(input).toHaveFocus();
  await expect.element(page.getByText('taken', { exact: true })).toBeVisible();
});

it('keeps a refusal until its field is edited or the form is sent again', async () => {
  const answers = [new Refused('taken', 'name'), new Refused('taken', 'name'), new Refused('full')];
  open(() => Promise.reject(answers.shift() ?? new Refused('over')));
  const taken = page.getByText('taken', { exact: true });
  await button.click();
  await page.getByRole('combobox').selectOptions('push');
  await expect.element(taken).toBeVisible();
  await name.fill('other');
  await expect.element(taken).not.toBeInTheDocument();
  await button.click();
  await expect.element(taken).toBeVisible();
  await button.click();
  await expect.element(taken).not.toBeInTheDocument();
  // A refusal without a field is below the form.
  await expect.element(page.getByText('full', { exact: true })).toBeVisible();
  await expect.element(name).toBeValid();
});

it('is sent once until it is answered', async () => {
  let answer: (() => void) | undefined;
  let sent = 0;
  open(() => {
    sent += 1;
    return new Promise<void>((done) => (answer = done));
  });
  await button.click();
  await expect.element(button).toBeDisabled();
  await name.click();
  await userEvent.keyboard('{Enter}');
  answer?.();
  await expect.element(button).toBeEnabled();
  expect(sent).toBe(1);
});

it('opens and closes the help of a field by mouse and by keys', async () => {
  open(() => undefined);
  await page.getByText('More').click();
  const help = page.getByRole('button', { name: 'Help: Columns' });
  const text = page.getByText('Of the finest grid.');
  await expect.element(text).not.toBeVisible();
  await help.click();
  await expect.element(text).toBeVisible();
  await name.click();
  await expect.element(text).not.toBeVisible();
  for (const key of ['{Enter}', ' ']) {
    (help.element() as HTMLElement).focus();
    await userEvent.keyboard(key);
    await expect.element(text).toBeVisible();
    await userEvent.keyboard('{Escape}');
    await expect.element(text).not.toBeVisible();
    await expect.element(help).toHaveFocus();
  }
});
