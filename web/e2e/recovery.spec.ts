// Recovery maps: from a live moment to a trial that is set up again, exactly.

import type { RecoveryReport } from '../src/net/protocol.gen';
import { LONG, type Lab, expect, test } from './fixtures';
import { cells, makeMap, progress } from './support/recovery';
import { type Point, distance } from './support/table';
import { must, until } from './support/wait';

/** The middle of a cell. */
async function middleOf(lab: Lab): Promise<Point> {
  const answer = await lab.page.request.get(
    new URL('/api/recoveries/recovery-1', lab.page.url()).href,
  );
  const { cells } = (await answer.json()) as RecoveryReport;
  const { x_m, y_m } = must(cells.at(-1), 'a cell');
  return [must(x_m, 'x'), must(y_m, 'y')];
}

test('a recovery map of a live moment shows its cells, and a trial is set up', async ({ lab }) => {
  await makeMap(lab, '2');
  await expect(progress(lab)).toContainText('place on posts');
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
