// Going back: why a switch came, and what other controllers would have done from a moment on.

import { readFile } from 'node:fs/promises';
import { check, until } from './harness.mjs';
import { distance } from './lab.mjs';

/** The trial of the last such carry. */
let carried;

/** A carry with the bead taken away in the middle of it, delivered in the end. */
async function disturbedCarry(lab) {
  await lab.reset();
  const [goal] = lab.freePoints(await lab.point('bead'), 0.3, 0.5);
  await lab.click(goal);
  await lab.run();
  await until('transport', () => lab.state.leg_steps > 4);
  await lab.pause();
  // While time stands a drag puts the bead down: nothing depends on how fast this machine is.
  const bead = await lab.point('bead');
  const [away] = lab.freePoints(bead, 0.15, 0.25);
  const { mouse } = lab.page;
  await mouse.move(...(await lab.px(bead)));
  await mouse.down();
  await mouse.move(...(await lab.px(away)), { steps: 6 });
  await mouse.up();
  await until('the bead away', async () => distance(await lab.point('bead'), away) < 0.01);
  await lab.speed('4');
  await lab.run();
  await lab.delivered(1);
  await lab.pause();
  carried = lab.scene.trial;
}

/** The same, unless it is there already. */
async function withCarry(lab) {
  if (carried !== lab.scene.trial) await disturbedCarry(lab);
}

/** Opens an event in time by what it tells, through the others when it shares their button. */
async function openEvent(lab, kind) {
  const bar = lab.page.getByRole('toolbar', { name: 'Events in time' });
  await bar.getByRole('button').first().click();
  const card = lab.page.getByRole('dialog');
  const told = () => card.locator('h2, .why-sentence').allInnerTexts();
  for (;;) {
    const now = await told();
    if (now[0].startsWith(kind)) return card;
    await card.getByRole('button', { name: 'Next event' }).click();
    await until('the next event', async () => (await told()).join() !== now.join());
  }
}

export async function tellsWhy({ lab }) {
  await disturbedCarry(lab);
  const card = await openEvent(lab, 'Switch');
  const told = await until('the story', async () => {
    const text = await card.innerText();
    return text.includes('over the limit') && text;
  });
  check(
    /Sub-controller 1 takes over: bead lost: \d+ mm away, more than T = 100 mm\./.test(told),
    told,
  );
  check(told.includes('Sub-controller 1 flies after it'), told);
  const picture = card.getByRole('img', { name: /What the camera saw/ });
  await until('the picture', () => picture.evaluate((image) => image.naturalWidth === 480));
  await lab.screenshot('why');
  const before = lab.state.tick;
  await card.getByRole('button', { name: 'Go there' }).click();
  await until('back in time', () => lab.state.tick < before);
  await until('the second sub-controller before', () => lab.state.mode === 2);
  await lab.page.keyboard.press('Escape');
  await card.waitFor({ state: 'detached' });
  const focused = await lab.page.evaluate(() => document.activeElement.className);
  check(focused === 'mark', `the focus went to ${focused}`);
}

export async function comparesControllers({ lab }) {
  await withCarry(lab);
  const { newest_tick: newest, world_hash: hash } = lab.state;
  const card = await openEvent(lab, 'Disturbance');
  await card.getByRole('button', { name: 'Compare controllers from here' }).click();
  const panel = lab.page.getByRole('tabpanel').filter({ has: lab.page.getByText('Play ghosts') });
  // What is cleared stays away though more of it is computed, until it is asked for again.
  await lab.button('Clear ghosts').click();
  const told = lab.comparison;
  await until('more of it', () => lab.comparison !== told || lab.comparison?.running === false);
  await lab.drawn();
  check((await panel.count()) === 0, 'cleared ghosts came back');
  await openEvent(lab, 'Disturbance');
  lab.sent.fork = undefined;
  await card.getByRole('button', { name: 'Compare controllers from here' }).click();
  await until('the question', () => lab.sent.fork);
  const rows = panel.getByRole('row');
  // What was known of this moment is shown until the new answers come: the last of these is waited for.
  await until('all of it', () => lab.comparison && !lab.comparison.running, 60_000);
  await lab.drawn();
  await until(
    'three results',
    async () => {
      const outcomes = await rows.evaluateAll((all) =>
        all.slice(1).map((row) => row.cells[1].innerText),
      );
      return outcomes.length === 3 && outcomes.every((text) => /^(delivered|stopped)/.test(text));
    },
    60_000,
  );
  const names = await rows.evaluateAll((all) => all.slice(1).map((row) => row.cells[0].innerText));
  check(/^RL,ERRT,Attractor\s*in use$/.test(names.join(',')), `rows: ${names}`);
  check(lab.state.world_hash === hash, 'the session moved');
  check(lab.state.newest_tick === newest, 'the future was lost');

  const time = lab.page.getByLabel('Time of the ghosts', { exact: true });
  const end = Number(await time.inputValue());
  check(end === Number(await time.getAttribute('max')), 'the ghosts do not stand at their end');
  await lab.screenshot('compare');
  const drawn = () => lab.canvas.evaluate((canvas) => canvas.toDataURL());
  const atEnd = await drawn();
  await lab.button('Play ghosts').click();
  await until('ghosts on their way', async () => Number(await time.inputValue()) < end - 50);
  await lab.button('Pause ghosts').click();
  check((await drawn()) !== atEnd, 'the ghosts do not move');
  await time.focus();
  const [before] = [Number(await time.inputValue())];
  await lab.page.keyboard.press('ArrowRight');
  check(Number(await time.inputValue()) > before, 'the key does not move the ghosts');
  await lab.button('Clear ghosts').click();
  check((await panel.count()) === 0, 'the ghosts are still there');

  // One controller alone, from the moment shown.
  await lab.page.getByLabel('Compare RL', { exact: true }).uncheck();
  await lab.page.getByLabel('Compare ERRT', { exact: true }).uncheck();
  await lab.button('Compare from here').click();
  await until('one result', async () => (await rows.count()) === 2, 60_000);
  await lab.button('Clear ghosts').click();

  // A story is of its own trial.
  await openEvent(lab, 'Goal');
  await lab.reset();
  await card.waitFor({ state: 'detached' });
  // Without a goal there is nothing to compare, and that is said here.
  await lab.button('Compare from here').click();
  await lab.notice('compare').waitFor();
  await lab.page.getByRole('tab', { name: 'Plots' }).click();
}

/** What was dragged a moment ago, as a file that the tests can repeat. */
export async function keepsADragAsACase({ lab }) {
  await withCarry(lab);
  await lab.page.getByRole('tab', { name: 'Events' }).click();
  const coming = lab.page.waitForEvent('download');
  await lab.page.getByRole('link', { name: 'Keep as test case' }).click();
  const download = await coming;
  check(/-seed-\d+\.json$/.test(download.suggestedFilename()), download.suggestedFilename());
  const kept = JSON.parse(await readFile(await download.path(), 'utf8'));
  check(kept.scenario.map === lab.scene.map, 'another map');
  const what = kept.inputs.map(({ input }) => Object.keys(input)[0]);
  check(what.includes('set_goal') && what.includes('place'), `it holds ${what.join()}`);
  check(kept.expect.deliveries >= 1, 'it expects nothing');
}
