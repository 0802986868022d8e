import { Show } from 'solid-js';
import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { fakeLab, show } from '../../lab/testingLab';
import { sceneOf } from '../../lab/testing';
import { ParameterForm } from './ParameterForm';
import { SwitchingLaw } from './SwitchingLaw';

// The name of a changed parameter ends in a dot.
const threshold = page.getByRole('spinbutton', { name: /^Threshold T( •)?$/ });
const { parameters } = sceneOf('posts');

async function open() {
  const { lab, server } = fakeLab();
  show(() => (
    <Show when={lab.scene()}>{(scene) => <ParameterForm lab={lab} scene={scene()} />}</Show>
  ));
  await expect.element(threshold).toHaveValue('10.0');
  return server;
}

it('sends all parameters, and shows those of the server', async () => {
  const server = await open();
  await threshold.fill('8');
  await userEvent.keyboard('{Enter}');
  const changed = { ...parameters, threshold_m: 0.08 };
  await expect.poll(() => server.command('configure')?.parameters).toEqual(changed);
  server.scene({ parameters: changed });
  server.done();
  await expect.element(threshold).toHaveValue('8.0');
  await page.getByRole('button', { name: 'Restore defaults' }).click();
  await expect.poll(() => server.command('configure')?.parameters).toEqual(parameters);
  server.scene({ parameters });
  server.done();
  await expect.element(threshold).toHaveValue('10.0');
});

it('shows the old value again when the server refuses an edit', async () => {
  const server = await open();
  await threshold.fill('8');
  await userEvent.keyboard('{Enter}');
  await expect.poll(() => server.command('configure')).toBeDefined();
  server.refuse('out_of_range', 'threshold_m is refused');
  await expect.element(threshold).toHaveValue('10.0');
});

it('reads a decimal comma, and keeps what is not a number, with the reason', async () => {
  const server = await open();
  await threshold.fill('7,5');
  await userEvent.keyboard('{Enter}');
  const changed = { ...parameters, threshold_m: 0.075 };
  await expect.poll(() => server.command('configure')?.parameters).toEqual(changed);
  server.scene({ parameters: changed });
  server.done();
  await expect.element(threshold).toHaveValue('7.5');
  const { length } = server.sent;
  await threshold.fill('7,5,1');
  await userEvent.tab();
  await expect.element(threshold).toHaveValue('7,5,1');
  await expect.element(threshold).toBeInvalid();
  await expect.element(threshold).not.toHaveFocus();
  await expect.element(threshold).toHaveAccessibleDescription('“7,5,1” is not a number.');
  expect(server.sent).toHaveLength(length);
});

it('sends nothing when a slider returns to its start', async () => {
  const server = await open();
  const slider = page.getByRole('slider', { name: 'Threshold T slider' });
  const move = (value: string): void => {
    const input = slider.element() as HTMLInputElement;
    input.value = value;
    input.dispatchEvent(new InputEvent('input', { bubbles: true }));
  };
  move('12');
  await expect.element(threshold).toHaveValue('12.0');
  // Released where it started, the browser reports no change.
  move('10');
  await expect.element(threshold).toHaveValue('10.0');
  expect(server.sent).toEqual([]);
});

it('shows one distance between tool and bead, that of now', async () => {
  const { lab, server } = fakeLab();
  show(() => (
    <Show when={lab.scene()}>
      {(scene) => (
        <Show when={lab.state()}>
          {(state) => <SwitchingLaw lab={lab} scene={scene()} state={state()} />}
        </Show>
      )}
    </Show>
  ));
  const reason = page.getByTestId('reason');
  for (const [code, threshold_m, shown] of [
    ['fetching', 0.01, 'Fetching: not yet within 1.0 cm.'],
    ['wall_between', 0.01, 'Fetching, but a wall is between.'],
    ['lost', 0.1, 'Bead lost: more than T = 10.0 cm.'],
  ] as const) {
    const why = { code, error_m: 0.155, threshold_m, text: '' };
    server.state({ reason: why, tracked_error_m: 0.133 });
    await expect.element(reason).toHaveTextContent(new RegExp(`^${shown}$`));
  }
  await expect.element(page.getByText('13.3 cm apart')).toBeVisible();
});

it('draws T on a fixed scale', async () => {
  const { lab, server } = fakeLab();
  show(() => (
    <Show when={lab.scene()}>
      {(scene) => (
        <Show when={lab.state()}>
          {(state) => <SwitchingLaw lab={lab} scene={scene()} state={state()} />}
        </Show>
      )}
    </Show>
  ));
  const at = async (threshold_m: number, shown: string): Promise<number> => {
    server.scene({ parameters: { ...parameters, threshold_m } });
    await expect.element(page.getByText(`2→1 at e > T = ${shown}`)).toBeVisible();
    const mark = document.querySelector<HTMLElement>('[data-limit="threshold"]');
    return Number.parseFloat(mark?.style.left ?? '');
  };
  await expect.element(page.getByText(/2→1 at e > T/)).toBeVisible();
  const [five, ten, twenty] = [await at(0.05, '5.0'), await at(0.1, '10.0'), await at(0.2, '20.0')];
  expect(ten).toBeGreaterThan(five);
  expect(twenty - ten).toBeCloseTo(2 * (ten - five), 3);
});
