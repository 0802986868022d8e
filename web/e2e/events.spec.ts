// Events: the explanation of a switch, test cases, and comparisons of controllers from a moment on.

import { readFile } from 'node:fs/promises';
import { type Lab, expect, test } from './fixtures';
import { CONTROL_STEP_TICKS } from './support/stepper';
import { distance } from './support/table';
import { until } from './support/wait';

const COMPUTED_MS = 60_000;
const SWITCHED =
  /Sub-controller 1 takes over: bead lost: \d+\.\d cm away, more than T = 10\.0 cm\./i;
const FLIES = /Sub-controller 1 flies to the bead/i;
const OVER_THE_LIMIT = /over the limit/i;

/** Steps through a transport, moves the bead away in the middle of it, and steps to the delivery. */
async function disturbedTransport(lab: Lab) {
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.3, 0.5)[0]);
  await lab.stepUntil('transport', () => lab.state.leg_steps > 4, CONTROL_STEP_TICKS);
  const [away] = lab.freePoints(await lab.bead(), 0.15, 0.25);
  await lab.startDrag(away);
  await lab.page.mouse.up();
  await until('the bead at its new place', async () => distance(await lab.bead(), away) < 0.01);
  await lab.deliver();
}

/** Opens an event of a kind. *Next event* reaches an event that shares its button with others. */
async function openEvent(lab: Lab, kind: string) {
  const bar = lab.page.getByRole('toolbar', { name: 'Events in time' });
  await bar.getByRole('button').first().click();
  const card = lab.page.getByRole('dialog');
  const texts = () => card.locator('#why-title, .why-sentence').allInnerTexts();
  for (;;) {
    const now = await texts();
    if (now[0]?.startsWith(kind)) return card;
    await card.getByRole('button', { name: 'Next event' }).click();
    await until('the next event', async () => (await texts()).join() !== now.join());
  }
}

test('explains a switch, and rewinds to it', async ({ lab }) => {
  await disturbedTransport(lab);
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
  await until('an earlier tick', () => lab.state.tick < before);
  await until('sub-controller 2', () => lab.state.mode === 2);
  await lab.page.keyboard.press('Escape');
  await expect(card).toHaveCount(0);
  await expect(lab.page.locator(':focus')).toHaveClass('mark');
});

test('keeps a drag as a test case', async ({ lab }) => {
  await disturbedTransport(lab);
  await lab.panel('Story');
  const downloading = lab.page.waitForEvent('download');
  await lab.page.getByRole('link', { name: 'Keep as test case' }).click();
  const download = await downloading;
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
  await disturbedTransport(lab);
  const { newest_tick: newest, world_hash: hash } = lab.state;
  const panel = lab.page.getByRole('tabpanel').filter({ has: lab.button('Play ghosts') });
  const card = await openEvent(lab, 'Disturbance');
  await card.getByRole('button', { name: 'Compare controllers from here' }).click();
  // A cleared comparison stays hidden while its results still come, until the next request.
  await lab.button('Clear ghosts').click();
  const cleared = lab.comparison;
  await until(
    'further results',
    () => lab.comparison !== cleared || lab.comparison?.running === false,
  );
  await lab.drawn();
  await expect(panel).toHaveCount(0);
  // Its last result must not be taken for one of the next request.
  await until('its end', () => lab.comparison?.running === false, COMPUTED_MS);

  await openEvent(lab, 'Disturbance');
  lab.sent = {};
  await card.getByRole('button', { name: 'Compare controllers from here' }).click();
  await until('the request', () => lab.sent.fork);
  // The page shows the earlier results of this moment until new ones come: wait for the last one.
  await until('all results', () => lab.comparison?.running === false, COMPUTED_MS);
  await lab.drawn();
  const rows = panel.getByRole('table', { name: /^Results of each/ }).getByRole('row');
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
      return outcomes.length === 3 && outcomes.every((text) => /^(delivered|stuck)/.test(text));
    },
    COMPUTED_MS,
  );
  const onTimeLine = lab.page.locator('.time-row').getByRole('img', { name: /: .+ after / });
  await expect(onTimeLine, 'the outcomes on the time line').toHaveCount(3);
  expect((await column(0)).join()).toMatch(/^RL,ERRT,Attractor\s*was in use$/);
  // Evaluations have the same definition.
  for (const axis of ['x', 'y']) {
    const head = panel.getByRole('rowheader', { name: `Largest ${axis}`, exact: true });
    await expect(head).toHaveAttribute('title', `Largest difference in ${axis} during transport`);
  }
  expect(lab.state.world_hash, 'the session changed').toBe(hash);
  expect(lab.state.newest_tick, 'the later ticks were lost').toBe(newest);

  const time = lab.label('Time of the ghosts');
  const now = async () => Number(await time.inputValue());
  const end = await now();
  expect(end, 'the ghosts are at their end').toBe(Number(await time.getAttribute('max')));
  const drawn = () => lab.canvas.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
  const atEnd = await drawn();
  await lab.button('Play ghosts').click();
  await until('ghosts before their end', async () => (await now()) < end - 50);
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
  await lab.page.getByRole('button', { name: /^Compare from/ }).click();
  await expect(rows).toHaveCount(2, { timeout: COMPUTED_MS });
  await lab.button('Clear ghosts').click();
});
