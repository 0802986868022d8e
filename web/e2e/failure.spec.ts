// The card that explains why a goal was not reached, and what it offers.

import { LONG, type Lab, type Session, expect, test } from './fixtures';
import { violations } from './support/axe';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { until } from './support/wait';

/** The paper's law stops in front of the middle of a wall. */
const STUCK =
  '#v=1&map=posts&controller=attractor&seed=1&start=-0.05,-0.3&goal=0.13,-0.3&attractor_law=literal';
const CAUSE = /^Attractor is too near a wall to go on\. It stopped: 150 steps/;
const FAILED_MS = 60_000;

const cardOf = (lab: Lab) => lab.page.getByRole('status', { name: 'Not delivered' });

async function fail(openLab: (options: { url: string }) => Promise<Lab>, session: Session) {
  const lab = await openLab({ url: session.url + STUCK });
  await until('the experiment', () => lab.scene.parameters.attractor_law === 'literal');
  await lab.stepUntil('the stop', () => lab.state.phase.code === 'stopped');
  await expect(cardOf(lab).locator('p')).toHaveText(CAUSE);
  return lab;
}

test('explains a failure, and delivers by another controller', async ({ openLab, session }) => {
  const lab = await fail(openLab, session);
  expect(await violations(lab.page)).toEqual([]);
  expect(faultsOf(await controls(lab.page), MIN_SIDE_PX.mouse)).toEqual([]);
  // The event's story has the same words.
  await lab.panel('Story');
  await lab.page.getByRole('button', { name: /^Why: Stopped/ }).click();
  const story = lab.page.getByRole('dialog');
  await expect(story.locator('.why-cause')).toHaveText(CAUSE);
  await story.getByRole('button', { name: 'Close' }).click();
  // A controller that is chosen afterwards is not to blame.
  await lab.controller('RL');
  await lab.drawn();
  await expect(cardOf(lab).locator('p')).toHaveText(CAUSE);
  await lab.button('Try ERRT').click();
  await expect(cardOf(lab)).toHaveCount(0);
  await until('ERRT', () => lab.state.controller === 'errt' && lab.state.running);
  await lab.pause();
  await lab.deliver();
  await expect(cardOf(lab)).toHaveCount(0);
});

test('goes on after a failure, and compares from the start', LONG, async ({ openLab, session }) => {
  const lab = await fail(openLab, session);
  const steps = lab.state.steps;
  await lab.speed('64');
  await lab.button('Go on for 150 more steps').click();
  await until('further steps', () => lab.state.steps > steps + 10);
  await expect(cardOf(lab)).toBeVisible({ timeout: FAILED_MS });
  await cardOf(lab).getByRole('button', { name: 'Close' }).click();
  await expect(cardOf(lab)).toHaveCount(0);

  await lab.reset({ speed: '64' });
  await lab.run();
  await expect(cardOf(lab)).toBeVisible({ timeout: FAILED_MS });
  await lab.button('Compare from the start').click();
  await until('the comparison', () => lab.comparison?.running === false, FAILED_MS);
  expect(lab.sent.fork?.tick, 'it starts with the goal').toBe(0);
  const rows = lab.page.getByRole('table', { name: /^Results of each/ }).getByRole('row');
  await expect(rows.filter({ hasText: 'ERRT' })).toContainText('delivered');
  await expect(rows.filter({ hasText: 'Attractor' })).toContainText('out of steps');
});
