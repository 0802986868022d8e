// Going back: why a switch came, and what other controllers would have done from a moment on.

import { readFile } from 'node:fs/promises';
import { type Lab, expect, test } from './fixtures';
import { distance } from './support/table';
import { must, until } from './support/wait';

const COMPUTED_MS = 60_000;
const SWITCHED = /Sub-controller 1 takes over: bead lost: \d+ mm away, more than T = 100 mm\./i;
const FLIES = /Sub-controller 1 flies to the bead/i;
const OVER_THE_LIMIT = /over the limit/i;

/** A carry with the bead taken away in the middle of it, delivered in the end. */
async function disturbedCarry(lab: Lab) {
  await lab.reset({ speed: '4' });
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.3, 0.5)[0]);
  await lab.run();
  await until('transport', () => lab.state.leg_steps > 4);
  await lab.pause();
  // While paused a drag puts the bead down: nothing depends on how fast this machine is.
  const [away] = lab.freePoints(await lab.bead(), 0.15, 0.25);
  await lab.pull(away);
  await lab.page.mouse.up();
  await until('the bead away', async () => distance(await lab.bead(), away) < 0.01);
  await lab.speed('8');
  await lab.run();
  await lab.delivered(1);
  await lab.pause();
}

/** Opens an event of a kind, by way of the others when they share a button. */
async function openEvent(lab: Lab, kind: string) {
  const bar = lab.page.getByRole('toolbar', { name: 'Events in time' });
  await bar.getByRole('button').first().click();
  const card = lab.page.getByRole('dialog');
  const texts = () => card.locator('h2, .why-sentence').allInnerTexts();
  for (;;) {
    const now = await texts();
    if (now[0]?.startsWith(kind)) return card;
    await card.getByRole('button', { name: 'Next event' }).click();
    await until('the next event', async () => (await texts()).join() !== now.join());
  }
}

test('explains a switch', async ({ lab }) => {
  await disturbedCarry(lab);
  const card = await openEvent(lab, 'Switch');
  await expect(card).toContainText(OVER_THE_LIMIT);
  await expect(card).toContainText(SWITCHED);
  await expect(card).toContainText(FLIES);
  const picture = card.getByRole('img', { name: /What the camera saw/ });
  await expect
    .poll(() => picture.evaluate((image: HTMLImageElement) => image.naturalWidth))
    .toBe(480);
  const before = lab.state.tick;
  await card.getByRole('button', { name: 'Rewind to here' }).click();
  await until('back in time', () => lab.state.tick < before);
  await until('the second sub-controller before', () => lab.state.mode === 2);
  await lab.page.keyboard.press('Escape');
  await expect(card).toHaveCount(0);
  await expect(lab.page.locator(':focus')).toHaveClass('mark');
});

test('keeps a drag as a test case', async ({ lab }) => {
  await disturbedCarry(lab);
  await lab.tab('Events').click();
  const coming = lab.page.waitForEvent('download');
  await lab.page.getByRole('link', { name: 'Keep as test case' }).click();
  const download = await coming;
  expect(download.suggestedFilename()).toMatch(/-seed-\d+\.json$/);
  const kept = JSON.parse(await readFile(await download.path(), 'utf8')) as {
    scenario: { map: string };
    inputs: { input: Record<string, unknown> }[];
    expect: { deliveries: number };
  };
  expect(kept.scenario.map).toBe(lab.scene.map);
  const inputs = kept.inputs.map(({ input }) => Object.keys(input)[0]);
  expect(inputs).toEqual(expect.arrayContaining(['set_goal', 'place']));
  expect(kept.expect.deliveries).toBeGreaterThanOrEqual(1);
});

test('compares controllers from a moment on', async ({ lab }) => {
  await disturbedCarry(lab);
  const { newest_tick: newest, world_hash: hash } = lab.state;
  const panel = lab.page.getByRole('tabpanel').filter({ has: lab.button('Play ghosts') });
  const card = await openEvent(lab, 'Disturbance');
  await card.getByRole('button', { name: 'Compare controllers from here' }).click();
  // What is cleared stays away though more of it is computed, until it is requested again.
  await lab.button('Clear ghosts').click();
  const first = lab.comparison;
  await until('more of it', () => lab.comparison !== first || lab.comparison?.running === false);
  await lab.drawn();
  await expect(panel).toHaveCount(0);

  await openEvent(lab, 'Disturbance');
  lab.sent = {};
  await card.getByRole('button', { name: 'Compare controllers from here' }).click();
  await until('the request', () => lab.sent.fork);
  // What was computed of this moment is shown until the new answers come: the last of these is waited for.
  await until('all of it', () => lab.comparison?.running === false, COMPUTED_MS);
  const rows = panel.getByRole('row');
  const column = (index: number) =>
    rows.evaluateAll(
      (all, cell) =>
        all.slice(1).map((row) => (row as HTMLTableRowElement).cells[cell]?.innerText ?? ''),
      index,
    );
  await until(
    'three results',
    async () => {
      const outcomes = await column(1);
      return outcomes.length === 3 && outcomes.every((text) => /^(delivered|stopped)/.test(text));
    },
    COMPUTED_MS,
  );
  expect((await column(0)).join()).toMatch(/^RL,ERRT,Attractor\s*in use$/);
  expect(lab.state.world_hash, 'the session moved').toBe(hash);
  expect(lab.state.newest_tick, 'the future was lost').toBe(newest);

  const time = lab.label('Time of the ghosts');
  const now = async () => Number(await time.inputValue());
  const end = await now();
  expect(end, 'the ghosts are at their end').toBe(Number(await time.getAttribute('max')));
  const drawn = () => lab.canvas.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
  const atEnd = await drawn();
  await lab.button('Play ghosts').click();
  await until('ghosts on their path', async () => (await now()) < end - 50);
  await lab.button('Pause ghosts').click();
  expect((await drawn()) === atEnd, 'the ghosts do not move').toBe(false);
  await time.focus();
  const before = await now();
  await lab.page.keyboard.press('ArrowRight');
  expect(await now(), 'the key does not move the ghosts').toBeGreaterThan(before);
  await lab.button('Clear ghosts').click();
  await expect(panel).toHaveCount(0);

  // One controller alone, from the moment shown.
  for (const name of ['RL', 'ERRT']) await lab.label(`Compare ${name}`).uncheck();
  await lab.button('Compare from here').click();
  await expect(rows).toHaveCount(2, { timeout: COMPUTED_MS });
  await lab.button('Clear ghosts').click();
});

test('closes a story with its trial, and compares nothing without a goal', async ({ lab }) => {
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
  await lab.run();
  await lab.later(10);
  await lab.pause();
  const card = await openEvent(lab, 'Goal');
  await lab.reset();
  await expect(card).toHaveCount(0);
  if (lab.state.goal_m) await lab.button('Clear goal').click();
  await until('no goal', () => !lab.state.goal_m);
  await lab.tab('Compare').click();
  await lab.button('Compare from here').click();
  must(await lab.notice('compare').innerText(), 'a refusal');
});
