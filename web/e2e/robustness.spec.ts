// Robustness: an evaluation over one varied parameter, and over two.

import { LONG, type Lab, expect, test } from './fixtures';

const RUN_MS = 90_000;

async function run({ page }: Lab, controllers: readonly string[], first: string, second: string) {
  const form = page.getByRole('complementary', { name: 'New evaluation' });
  // The view is loaded when it opens.
  await expect(form.getByRole('checkbox', { name: 'open', exact: true })).toBeVisible();
  for (const box of await form.getByRole('checkbox').all()) await box.setChecked(false);
  for (const name of [...controllers, 'open', '0']) {
    await form.getByRole('checkbox', { name, exact: true }).check();
  }
  for (const [index, choice] of [first, second].entries()) {
    if (choice === '') continue;
    const label = index === 0 ? 'Vary a parameter' : 'Vary a second parameter';
    await form.getByLabel(label).selectOption(choice);
    await form.getByLabel('Values', { exact: true }).nth(index).fill('2');
  }
  await form.getByLabel('Episodes per cell', { exact: true }).fill('2');
  await form.getByRole('button', { name: 'Run', exact: true }).click();
  await expect(page.getByTestId('evaluation-stage')).toHaveText('done', { timeout: RUN_MS });
}

test('draws deliveries and errors over a parameter', async ({ lab }) => {
  await lab.view('Evaluate').click();
  await run(lab, ['Attractor'], 'friction', '');
  const section = lab.page.getByRole('region', { name: 'Robustness on open, 0 disturbances' });
  const curve = section.getByRole('img', { name: /^Delivered over / });
  await expect(curve).toHaveAccessibleName(/: Attractor \d+ \(\d+ to \d+\)/);
  await expect(section.getByRole('img', { name: /^Mean tracking error over / })).toBeVisible();
  await expect(section.locator('canvas')).toHaveCount(2);
  await expect(lab.page.getByTestId('evaluation-row')).toHaveCount(2);
  await expect(lab.page.getByRole('columnheader', { name: 'Varied' })).toBeVisible();
});

test('shows deliveries over two parameters as a grid', LONG, async ({ lab }) => {
  await lab.view('Evaluate').click();
  await run(lab, ['ERRT', 'Attractor'], 'friction', 'tracker_noise_m');
  const grids = lab.page.locator('.robustness-grid');
  await expect(grids).toHaveCount(2);
  await expect(grids.first().locator('caption')).toHaveText('ERRT: delivered, %');
  // Cells fill one after the other.
  await expect(grids.first().locator('tbody td')).toHaveText(Array(4).fill(/^(0|50|100)$/), {
    timeout: RUN_MS,
  });
});
