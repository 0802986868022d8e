// Recovery maps: from a live moment to a trial that is set up again, exactly.

import type { Recoveries, RecoveryReport } from '../src/net/protocol.gen';
import { LONG, type Lab, expect, test } from './fixtures';
import { cells, makeMap, progress } from './support/recovery';
import { type Point, distance } from './support/table';
import { must, until } from './support/wait';

/** The newest recovery map. */
async function reportOf({ page }: Lab): Promise<RecoveryReport> {
  const read = async (path: string): Promise<unknown> =>
    (await page.request.get(new URL(`/api/recoveries${path}`, page.url()).href)).json();
  const { recoveries } = (await read('')) as Recoveries;
  const { id } = must(recoveries.at(-1), 'a recovery map');
  return (await read(`/${id}`)) as RecoveryReport;
}

/** The middle of a cell. */
async function middleOf(lab: Lab): Promise<Point> {
  const { cells } = await reportOf(lab);
  const { x_m, y_m } = must(cells.at(-1), 'a cell');
  return [must(x_m, 'x'), must(y_m, 'y')];
}

test('a recovery map of a live moment shows its cells, and a trial is set up', async ({ lab }) => {
  await makeMap(lab, '2');
  await expect(progress(lab)).toContainText('Put elsewhere on posts');
  const { tick } = lab.state;
  const first = cells(lab).first();
  await first.click();
  await expect(lab.page.getByTestId('recovery-cell')).toHaveText(/^2 delivered; median [\d.]+ s$/);
  const before_m = lab.state.bead_m;
  await lab.button('Set up trial 2').click();
  await until('the moment', () => lab.state.tick === tick && lab.state.controller === 'errt');
  await until('the disturbance', () => distance(lab.state.bead_m, before_m) > 0.01);
  await lab.deliver();

  // Keys choose among the cells.
  const before = await lab.page.locator('.cell.chosen').first().getAttribute('data-cell');
  await lab.page.getByRole('application', { name: /^ERRT: cells/ }).press('ArrowRight');
  await expect(lab.page.locator('.cell.chosen').first()).not.toHaveAttribute(
    'data-cell',
    before ?? '',
  );
  await lab.label('Show').selectOption({ label: 'ERRT minus Attractor' });
  await expect(
    lab.page.getByRole('application', { name: /^ERRT minus Attractor: cells/ }),
  ).toBeVisible();
});

test('a press on the map opens a cell; a map of another goal is off the map', async ({ lab }) => {
  await makeMap(lab);
  // The page may still show the map of the test before.
  await expect.poll(async () => (await reportOf(lab)).stage).toBe('done');
  const said = /^At most (\d+) trials/;
  const size = await lab.page.getByTestId('recovery-size').textContent();
  const { planned } = await reportOf(lab);
  expect(Number(must(said.exec(size ?? ''), size ?? 'a size')[1])).toBeGreaterThanOrEqual(planned);
  const { goal_m } = lab.state;
  const canvas = lab.page.locator('canvas.plan-canvas');
  const middle = await lab.px(await middleOf(lab));
  await lab.page.mouse.move(...middle);
  await expect(canvas).toHaveAttribute('data-cursor', 'pressable');
  await lab.page.mouse.click(...middle);
  await expect(lab.page.getByTestId('recovery-cell')).toHaveText(
    /^1 (not delivered|delivered|late)/,
  );
  await expect(lab.page.getByTestId('recovery-cell')).toBeInViewport();
  expect(lab.state.goal_m).toEqual(goal_m);

  await lab.panel('Now');
  await lab.page.mouse.click(...middle);
  await until('another goal', () => lab.state.goal_m?.[0] !== goal_m?.[0]);
  await lab.button('Layers').click();
  await expect(lab.label('Recovery')).toBeDisabled();
  await lab.button('Close').click();
  await lab.panel('Recovery');
  await expect(progress(lab)).toContainText('to another goal than the present one');
});

test('a drag by hand shows in which cell it ended', LONG, async ({ lab }) => {
  await makeMap(lab);
  const { mouse } = lab.page;
  // On a coarse map some places belong to no cell.
  const to = await middleOf(lab);
  await mouse.move(...(await lab.px(await lab.bead())));
  await mouse.down();
  await mouse.move(...(await lab.px(to)), { steps: 5 });
  await until('the hand there', () => lab.state.hand_m && distance(lab.state.hand_m, to) < 0.005);
  await mouse.up();
  await expect(
    lab.page.getByText(/^Your last drag ended here: \d delivered/).first(),
  ).toBeVisible();
  await expect(lab.page.locator('.cell.dropped')).toHaveCount(1);
});
