// Two browsers at one session: who may act, what the other sees, and what becomes of a hold.

import { check, until } from './harness.mjs';
import { Lab, distance } from './lab.mjs';

const ACTS = [
  'Run',
  'Step',
  'Reset',
  'Open map…',
  'New seed',
  'Restore defaults',
  'Disturb',
  'Clear goal',
];

/** Two pages: the one that was there is the operator. */
async function withViewer({ browser, server }, work) {
  const viewer = await Lab.open(browser, server.url);
  try {
    check((await viewer.text('role')) === 'viewer', 'a second browser became the operator');
    await work(viewer);
  } finally {
    await viewer.page.context().close();
  }
}

async function watches(context) {
  const { lab } = context;
  await lab.reset();
  await withViewer(context, async (viewer) => {
    for (const name of ACTS) {
      check(await viewer.button(name).isDisabled(), `a viewer is offered ${name}`);
    }
    for (const field of await viewer.page.locator('.parameters input, .parameters select').all()) {
      check(await field.isDisabled(), 'a viewer may change a parameter');
    }
    // The workspace is no button: it says why it does nothing.
    await viewer.click(viewer.freePoints(await viewer.point('bead'), 0.1, 0.3)[0]);
    await viewer.notice('workspace').getByText('Take control').waitFor();
    check(!viewer.sent.set_goal, 'a viewer asked for a goal');

    const before = viewer.state;
    const heard = viewer.events.length;
    await lab.click(lab.freePoints(await lab.point('bead'), 0.1, 0.3)[0]);
    await lab.run();
    await until('the goal', () => viewer.state.goal_m);
    await until('the bead on its way', () => distance(viewer.state.bead_m, before.bead_m) > 0.01);
    await until('time', async () => (await viewer.text('tick')) !== `tick ${before.tick}`);
    check(viewer.events.length > heard, 'the viewer heard of no event');
    await viewer.page.getByRole('log').getByText('goal placed').first().waitFor();
    check(await viewer.button('Pause').isDisabled(), 'a viewer may pause');
    await lab.button('Pause').click();
    await until('paused', () => !viewer.state.running);
  });
}

async function handsOver(context) {
  const { lab } = context;
  await withViewer(context, async (viewer) => {
    // Asked for, control is given when the operator lets go of it.
    await viewer.button('Take control').click();
    await viewer.notice('session').getByText('has to release control').waitFor();
    await lab.page.getByTestId('asked').waitFor();
    await lab.page.getByRole('log').getByText('asks for control').first().waitFor();
    check((await lab.text('role')) === 'operator', 'the operator lost control by being asked');
    await lab.button('Release control').click();
    await until('the operator', async () => (await viewer.text('role')) === 'operator');
    await until('a viewer', async () => (await lab.text('role')) === 'viewer');
    check(await viewer.button('Run').isEnabled(), 'the new operator may not run');
    check(await lab.button('Run').isDisabled(), 'the old operator may run');

    // Released and nobody's, it is there to take.
    await viewer.button('Release control').click();
    await until('nobody', async () => (await viewer.text('role')) === 'viewer');
    await lab.button('Take control').click();
    await until('the operator again', async () => (await lab.text('role')) === 'operator');
  });
}

async function letsGo(context) {
  const { lab } = context;
  await lab.reset();
  await lab.button('Release control').click();
  await lab.button('Take control').waitFor();
  // The other one becomes the operator by coming, and goes while it holds the bead.
  const other = await Lab.open(context.browser, context.server.url);
  await until('the operator', async () => (await other.text('role')) === 'operator');
  const bead = await other.point('bead');
  const { mouse } = other.page;
  await mouse.move(...(await other.px(bead)));
  await mouse.down();
  await mouse.move(...(await other.px(other.freePoints(bead, 0.05, 0.1)[0])), { steps: 4 });
  await until('the hand, seen by the viewer', () => lab.state.hand_m);
  await other.page.context().close();
  await until('no hand', () => !lab.state.hand_m);
  await lab.button('Take control').click();
  await until('the operator', async () => (await lab.text('role')) === 'operator');
}

export const PAIR = [
  ['shows a viewer everything and offers nothing', watches],
  ['hands control over when asked and when released', handsOver],
  ['lets go of the bead when its operator is gone', letsGo],
];
