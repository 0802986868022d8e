// What each controller shows: RL's value map and action values, ERRT's plan, the attractor flow.

import { type Lab, expect, test } from './fixtures';
import { CONTROL_STEP_TICKS } from './support/stepper';
import type { PointLike } from './support/table';
import { openLayers, showPanel, showTabs } from './support/preconditions';
import { must, until } from './support/wait';

/** The server sweeps a map before it first sends values. */
const FIRST_VALUES_MS = 60_000;
const WITHOUT_GOAL = /Set a goal/i;

/** Checks that a layer changes the picture around `points`, and that hiding it restores it. */
async function expectLayer(lab: Lab, layer: string, points: readonly PointLike[]) {
  await lab.layer(layer, false);
  // The plan is drawn with the next frame.
  await lab.page.evaluate(
    () =>
      new Promise((resolve) => {
        requestAnimationFrame(() => requestAnimationFrame(resolve));
      }),
  );
  const bare = await lab.pixelsAround(...points);
  await lab.layer(layer);
  await until(`the layer ${layer}`, async () => (await lab.pixelsAround(...points)) !== bare);
  await lab.layer(layer, false);
  await until(`no layer ${layer}`, async () => (await lab.pixelsAround(...points)) === bare);
  await lab.layer(layer);
}

test('shows the value map of a policy', async ({ lab }) => {
  const { page } = lab;
  // The smallest map: the server sweeps it before it sends values. By a policy without a memory, so that they stay.
  await lab.map('u-turn');
  await lab.controller('RL');
  const choose = async (label: string, policy: string) => {
    await showPanel('Tune')(lab);
    await lab.label('Policy').selectOption(label);
    await until(label, () => lab.scene.parameters.rl_policy === policy);
  };
  await choose('General', 'general');
  let requests = 0;
  page.on('request', (request) => {
    if (request.url().endsWith('/values')) requests += 1;
  });

  const legend = page.getByRole('group', { name: 'Values' });
  await lab.layer('Value');
  await openLayers(lab);
  await expect(legend).toContainText(WITHOUT_GOAL);
  const bead = await lab.bead();
  const goal = must(lab.freePoints(bead, 0.06, 0.2).at(-1), 'a goal');
  const places = lab.freePoints(bead, 0.04, 0.1).slice(0, 3);
  const bare = await until('a picture that does not change', async () => {
    const first = await lab.pixelsAround(...places);
    return first === (await lab.pixelsAround(...places)) && first;
  });
  await lab.click(goal);
  await expect(page.getByTestId('value-least')).toHaveCount(1, { timeout: FIRST_VALUES_MS });
  expect(await lab.number('value-least')).toBeLessThan(await lab.number('value-greatest'));
  await until('the layer Value', async () => (await lab.pixelsAround(...places)) !== bare);

  await showTabs(lab);
  await lab.tune('Threshold T', '8');
  await lab.label('Shield').uncheck();
  await until('no shield', () => !lab.scene.parameters.rl_shield);
  expect(requests, 'requests for one goal').toBe(1);
  await choose('Colon', 'colon');
  await until('values by that policy', () => requests === 2);
  await lab.restoreDefaults();
  expect(lab.scene.parameters.rl_shield && lab.scene.parameters.rl_policy).toBe('auto');
  await openLayers(lab);
  await page.getByRole('group', { name: 'Layers' }).getByLabel('Value', { exact: true }).uncheck();
  await expect(legend).toHaveCount(0);
});

test('shows the action values of a policy and its decision', async ({ lab }) => {
  const { page } = lab;
  await lab.reset({ map: 'colon' });
  await lab.controller('RL');
  await lab.setGoal(must(lab.freePoints(await lab.bead(), 0.25, 0.4).at(-1), 'a goal'));
  await lab.stepUntil('a judgement', () => lab.overlay?.judgement, CONTROL_STEP_TICKS);
  const names = ['plus-x', 'minus-x', 'plus-y', 'minus-y'];
  // The page may be a frame behind the last message.
  const { values, judgement } = await until('the last values on the page', async () => {
    const received = lab.overlay;
    const now = await Promise.all(names.map((name) => lab.number(`rl-value-${name}`)));
    const isSame = now.every(
      (value, index) => Math.abs(value - (received?.judgement?.values[index] ?? NaN)) < 0.001,
    );
    return (
      received?.judgement &&
      received === lab.overlay &&
      isSame && { values: now, judgement: received.judgement }
    );
  });
  const { taken, trained_on } = judgement;
  const best = values.indexOf(Math.max(...values));
  const words = await lab.text('rl-decision');
  expect(words).toMatch(new RegExp(`^${['Right', 'Left', 'Up', 'Down'][taken] ?? ''} `));
  expect(words.includes('The shield refused'), `${values.join()}, but ${words}`).toBe(
    best !== taken,
  );
  await expect(page.getByTestId('rl-trained-on')).toHaveText(trained_on.join(', '));
  await expect(page.getByTestId('rl-unseen')).toHaveCount(0);

  await lab.deliver();
  await lab.controller('Attractor');
  await expect(page.getByTestId('rl-taken')).toHaveCount(0);
});

test('reports that the policy plans with what it has seen on a map it was not trained on', async ({
  lab,
}) => {
  await lab.map('attractor-example-arm');
  await lab.controller('RL');
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.06, 0.2)[0]);
  await lab.stepUntil('a judgement', () => lab.overlay?.judgement, CONTROL_STEP_TICKS);
  await expect(lab.page.getByTestId('rl-memory')).toContainText('not on this map');
  expect(lab.overlay?.judgement?.trained_on).not.toContain(lab.scene.map);
});

test('carries the bead along a planned path', async ({ lab }) => {
  await lab.reset({ map: 'colon' });
  await lab.controller('ERRT');
  await lab.setGoal(must(lab.freePoints(await lab.bead(), 0.25, 0.4).at(-1), 'a goal'));
  const wayOf = () => lab.overlay?.plan?.way.length ?? 0;
  await lab.stepUntil('some of the path', () => wayOf() > 1, CONTROL_STEP_TICKS);
  expect(await lab.number('plan-plans')).toBeGreaterThanOrEqual(1);
  await expect(lab.page.getByTestId('plan-way')).toHaveText(/cm$/);

  const { way, obstacles } = must(lab.overlay?.plan, 'a plan');
  await expectLayer(lab, 'Plan', way.slice(0, 3));
  const largest = obstacles
    .map(({ x_min_m, x_max_m, y_min_m, y_max_m }) => ({
      at: [x_max_m, (y_min_m + y_max_m) / 2] as const,
      area: (x_max_m - x_min_m) * (y_max_m - y_min_m),
    }))
    .sort((a, b) => b.area - a.area)
    .slice(0, 3);
  await expectLayer(
    lab,
    'Obstacles',
    largest.map(({ at }) => at),
  );
  await lab.layer('Obstacles', false);
  await lab.deliver();
  await lab.controller('Attractor');
  await expect(lab.page.getByTestId('plan-plans')).toHaveCount(0);
});

test('shows the attractor flow, and closes a menu without setting a goal', async ({ lab }) => {
  const legend = lab.page.getByRole('group', { name: 'Arrows and dots' });
  await lab.layer('Attractor flow');
  await openLayers(lab);
  await expect(legend).toContainText(WITHOUT_GOAL);
  const goal = lab.freePoints(await lab.bead(), 0.3, 0.5)[0];
  await lab.setGoal(goal);
  await expect(lab.page.getByTestId('flow-traps')).toHaveText(/\d|none/);
  await expect(legend).toContainText(/direction of the attractor flow/i);
  await lab.button('Layers').click();

  // Points of the grid. An arrow crosses each of them that is not over a wall.
  const { x_min_m, x_max_m, y_min_m, y_max_m } = lab.scene.workspace;
  const spacing_m = Math.max(x_max_m - x_min_m, y_max_m - y_min_m) / 40;
  const across = Math.floor((y_max_m - y_min_m) / spacing_m + 1e-9);
  const margin_m = (y_max_m - y_min_m - across * spacing_m) / 2;
  await expectLayer(
    lab,
    'Attractor flow',
    [8, 20, 32].map((column) => [
      x_min_m + column * spacing_m,
      y_min_m + margin_m + 11 * spacing_m,
    ]),
  );

  // A click beside a menu only closes it.
  await lab.button('More').click();
  const menu = lab.page.getByRole('link', { name: 'Present' });
  await menu.waitFor();
  lab.sent = {};
  // On the left, which the menu does not cover.
  const beside = lab.freePoints(goal, 0.1, 0.6).find(([x]) => x < x_min_m + 0.1);
  await lab.click(must(beside, 'a point on the left'));
  await expect(menu).toHaveCount(0);
  // Sends the next message. A goal from the click would have been sent before it.
  await lab.button('Step').click();
  await until('a step', () => lab.sent.step);
  expect(lab.sent.set_goal, 'the click placed a goal').toBeUndefined();
});
