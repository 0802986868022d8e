// Kept runs: going back loses nothing.

import { expect, test } from './fixtures';
import { must, until } from './support/wait';

test('returns to what a rewind and a reset have left behind', async ({ lab }) => {
  const { page } = lab;
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.2, 0.3)[0]);
  await lab.deliver();
  const { tick, world_hash: hash } = lab.state;
  const kept = page.getByRole('button', { name: /^Kept runs/ });
  const before = lab.scene.kept_runs.length;

  // A look back loses nothing, so nothing is kept.
  await lab.label('Timeline').focus();
  for (let i = 0; i < 3; i++) await page.keyboard.press('PageDown');
  await until('an earlier tick', () => lab.state.tick < tick);
  expect(lab.scene.kept_runs.length).toBe(before);

  await lab.button('Step').click();
  await until('the kept run', () => lab.scene.kept_runs.length === before + 1);
  await expect(kept).toContainText(String(before + 1));
  await lab.reset();
  await until('two kept runs', () => lab.scene.kept_runs.length === before + 2);

  const newest = must(lab.scene.kept_runs.at(-1), 'the newest kept run').number;
  await expect(kept).toHaveAttribute('title', new RegExp(`^Run ${newest} was kept`));
  await kept.click();
  await expect(kept).not.toHaveAttribute('title', /was kept/);
  const { number } = must(lab.scene.kept_runs[before], 'the first kept run');
  const run = page.getByRole('listitem').filter({ hasText: `Run ${number}` });
  await expect(run).toContainText(/posts, seed \d+, .*, delivered 1×, last controller Attractor/);
  await run.getByRole('button').click();
  await until('the end of the first run', () => lab.state.tick === tick);
  expect(lab.state.world_hash).toBe(hash);
  await expect(kept).toBeFocused();
  await expect(page.getByTestId('deliveries')).toHaveText('1');
  // Its events are on the timeline again.
  const marks = page.getByRole('toolbar', { name: 'Events in time' });
  await expect(marks.getByRole('button').first()).toBeVisible();
  // Its lines in the list of events lead to their stories again.
  await lab.panel('Story');
  const delivery = page.getByRole('log').getByRole('button', { name: /^Why: Delivered/ });
  await expect(delivery).toHaveCount(1);
});
