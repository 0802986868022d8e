// Plots, magnet, scripted disturbances, time, keys and the voice of the page.

import { readFile } from 'node:fs/promises';
import { check, until } from './harness.mjs';
import { Lab, distance } from './lab.mjs';

const PARTS = ['a', 'b', 'c', 'd', 'e', 'f'];

const words = (lab, part) =>
  lab.page.locator(`[data-part=${part}] [role=img]`).getAttribute('aria-label');

async function saved(lab, kind) {
  const [file] = await Promise.all([
    lab.page.waitForEvent('download'),
    lab.button(`Save ${kind}`).click(),
  ]);
  return { name: file.suggestedFilename(), bytes: await readFile(await file.path()) };
}

export async function plotsThePapersFigure({ lab }) {
  const { page } = lab;
  await page.getByRole('tab', { name: 'Plots' }).click();
  await lab.reset({ speed: '8' });
  const bead = await lab.point('bead');
  await lab.click(lab.freePoints(bead, 0.25, 0.4)[0]);
  await lab.run();
  await until('some way', () => lab.state.sim_time_s > 4);
  await lab.pause();
  for (const part of PARTS) {
    await until(`numbers in ${part}`, async () => /\d/.test(await words(lab, part)));
  }

  // A pointer over one part reads the same moment in all of them.
  const box = await page.locator('[data-part=e] .plot-area').boundingBox();
  const places = await words(lab, 'f');
  await page.mouse.move(box.x + 0.35 * box.width, box.y + box.height / 2);
  const moment = await until('another moment', async () => {
    const at = /at ([\d.:]+ s)/.exec(await words(lab, 'e'))?.[1];
    return at && Math.abs(parseFloat(at) - lab.state.sim_time_s) > 1 && at;
  });
  for (const part of ['a', 'b', 'c', 'd']) {
    check((await words(lab, part)).includes(`at ${moment}`), `${part} tells another moment`);
  }
  check((await words(lab, 'f')) !== places, 'the way shows the present');
  await page.mouse.move(0, 0);

  // Going back keeps what came after, until time runs on from there.
  const rows = async () => (await saved(lab, 'CSV')).bytes.toString().trim().split('\n');
  const all = await rows();
  check(all[0].startsWith('tick,sim_time_s,tool_x_m'), `the table begins with ${all[0]}`);
  const end = lab.state.tick;
  const track = await page.getByLabel('Timeline').boundingBox();
  await page.mouse.click(track.x + 0.3 * track.width, track.y + track.height / 2);
  await until('an earlier tick', () => lab.state.tick < end / 2);
  check((await rows()).length === all.length, 'the future was forgotten');

  const svg = await saved(lab, 'SVG');
  check(svg.name.endsWith('.svg') && svg.bytes.includes('(f) Locus'), 'the drawing lacks a part');
  const png = await saved(lab, 'PNG');
  check(png.bytes.subarray(1, 4).toString() === 'PNG', 'the picture is none');

  const before = (await page.locator('.lower').boundingBox()).height;
  await lab.button('Larger').click();
  await until('a larger panel', async () => {
    const { height } = await page.locator('.lower').boundingBox();
    return height > 1.5 * before;
  });
  await lab.screenshot('plots-large');
  await lab.button('Larger').click();
}

export async function bendsTheCurvesBesideThem({ lab }) {
  const { page } = lab;
  await lab.reset();
  await page.getByRole('tab', { name: 'Magnet' }).click();
  await page.getByText('Magnet and bead', { exact: true }).click();
  const panel = page.getByRole('group', { name: 'Magnet and friction' });
  const liftOff = () => lab.text('magnet-weight');
  await until('an answer', async () => (await liftOff()).includes('%'));
  const before = await liftOff();

  // By keyboard: a press of an arrow is a millimetre, here and in the form.
  const height = panel.getByRole('slider', { name: 'Height' });
  await height.focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press('ArrowRight');
  await until('105 mm', () => Math.abs(lab.scene.parameters.tool_height_m - 0.105) < 1e-9);
  await until('more weight left', async () => (await liftOff()) !== before);
  const inForm = page.getByRole('spinbutton', { name: 'Tool height' });
  check((await inForm.inputValue()) === '105', `the form says ${await inForm.inputValue()}`);

  // And the other way.
  await inForm.fill('92');
  await inForm.press('Enter');
  await until('lift-off', async () => (await liftOff()).includes('lifts off'));
  const here = panel.getByRole('spinbutton', { name: 'Height' });
  await until('the panel', async () => (await here.inputValue()) === '92');

  await panel.getByRole('combobox', { name: 'Magnet' }).selectOption('C');
  await until('block C', () => lab.scene.parameters.block_orientation === 'C');
  await page.getByRole('radio', { name: 'the bead' }).check();
  await lab.screenshot('magnet-controls');
  await page.getByRole('radio', { name: 'x', exact: true }).check();
  await lab.button('Restore defaults').click();
  await until('the defaults', () => lab.scene.parameters.block_orientation === 'A');
  await page.getByText('Magnet and bead', { exact: true }).click();
  await page.getByRole('tab', { name: 'Plots' }).click();
}

export async function disturbsByScript({ lab }) {
  const { page } = lab;
  // So slow that a pause comes soon after the move, by the length of the timeline.
  await lab.reset({ speed: '2' });
  const { seed } = lab.scene;
  const start = await lab.point('bead');
  const goal = lab.freePoints(start, 0.3, 0.45)[0];
  const away = lab.freePoints(start, 0.15, 0.3).at(-1);
  await lab.click(goal);
  await until('the goal', () => lab.state.goal_m);
  const goal_m = lab.state.goal_m;

  await lab.button('Disturb').click();
  await page.getByLabel('Kind of disturbance').selectOption('Move');
  await page.getByLabel('Time of the disturbance').selectOption('at a time');
  await page.getByLabel('Time in seconds').fill('2');
  // The next click on the plan is the place, and no goal.
  await lab.button('Pick the new place on the map').click();
  await lab.click(away);
  const x = page.getByLabel('x of the new place in metres');
  await until('the place', async () => Math.abs(Number(await x.inputValue()) - away[0]) < 0.003);
  check(distance(lab.state.goal_m, goal_m) < 1e-9, 'picking moved the goal');
  const trial = lab.scene.trial;
  await lab.button('Add to script and restart').click();
  await until('a new trial', () => lab.scene.trial > trial && lab.state.tick === 0);
  check(lab.scene.seed === seed, 'the seed changed');
  check(distance(lab.state.goal_m, goal_m) < 1e-6, 'the goal was lost');
  check(distance(await lab.point('bead'), start) < 1e-6, 'the start changed');
  const entry = page.getByRole('list', { name: 'Script' }).getByRole('listitem');
  check((await entry.innerText()).startsWith('at 2.0 s: move to'), await entry.innerText());

  await lab.run();
  await until('the move', () => lab.state.disturbances === 1);
  await lab.pause();
  // Back before it: the hollow mark lies ahead.
  const track = await page.getByLabel('Timeline').boundingBox();
  await page.mouse.click(track.x + 0.2 * track.width, track.y + track.height / 2);
  await until('before it', () => lab.state.tick < 200 && lab.state.disturbances === 0);
  check((await page.locator('.script-marks circle').count()) === 1, 'no mark of the script');
  await lab.screenshot('script');

  await page.getByLabel('Number of random moves').fill('3');
  await lab.button('Set and restart').click();
  await until('random ones', () => lab.scene.scenario.disturbances === 3);
  check(lab.scene.scenario.script.length === 1, 'the script was lost');
  await page.getByRole('button', { name: /^Remove and restart/ }).click();
  await until('no script', () => lab.scene.scenario.script.length === 0);
  // The restart sets the field once more.
  await lab.drawn();
  await page.getByLabel('Number of random moves').fill('0');
  await page.keyboard.press('Enter');
  await until('none at random', () => lab.scene.scenario.disturbances === 0);

  // Now, by keyboard alone.
  await page.getByLabel('Time of the disturbance').selectOption('now');
  // Key by key, with signs and points, as one types it.
  for (const [field, value] of [
    [x, away[0]],
    [page.getByLabel('y of the new place in metres'), away[1]],
  ]) {
    await field.focus();
    await page.keyboard.press('ControlOrMeta+a');
    await page.keyboard.type(value.toFixed(3));
    check((await field.inputValue()) === value.toFixed(3), `typed: ${await field.inputValue()}`);
  }
  await x.press('Enter');
  await until('moved now', async () => distance(await lab.point('bead'), away) < 0.01);
  await lab.button('Disturb').click();
  // A restart has made the goal part of the scenario; a map chosen anew has none.
  await lab.reset({ map: 'colon' });
  await lab.reset();
  check(!lab.state.goal_m, 'the goal stays');
}

export async function keepsTime({ lab }) {
  await lab.reset();
  await lab.button('Step ¼ s').click();
  await until('a control step', async () => (await lab.text('tick')) === 'tick 32');
  await lab.button('Step ¼ s').click();
  await until('the next', () => lab.state.tick === 63);
  await lab.speed('64');
  await lab.run();
  const words = lab.page.locator('.achieved');
  await until('what is achieved', async () => {
    const text = await words.innerText();
    const [factor] = /[\d.]+/.exec(text) ?? [];
    // Only where less is achieved than asked does it say so.
    return factor && text.includes('machine limit') === Number(factor) < 54.4;
  });
  await lab.pause();
  await lab.speed('1');
}

export async function obeysKeysAllOver({ lab }) {
  const { page } = lab;
  const { keyboard } = page;
  await lab.reset();
  await page.getByRole('heading', { name: 'Workspace' }).click();
  await keyboard.press('.');
  await until('one tick', async () => (await lab.text('tick')) === 'tick 1');
  await keyboard.press(',');
  await until('the control step', () => lab.state.tick === 32);
  // What a key does follows from what the page shows, a frame after what its socket heard.
  const speed = page.getByLabel('Speed', { exact: true });
  await keyboard.press(']');
  await until('2×', async () => (await speed.inputValue()) === '2');
  await keyboard.press('[');
  await until('1×', async () => (await speed.inputValue()) === '1');
  await keyboard.press('2');
  await until('ERRT', () => lab.state.controller === 'errt');
  await keyboard.press('3');
  await until('attractor', () => lab.state.controller === 'attractor');
  await keyboard.press(' ');
  await lab.button('Pause').waitFor();
  await keyboard.press(' ');
  await lab.button('Run').waitFor();

  // Not while typing.
  const seed = page.getByLabel('Seed', { exact: true });
  await seed.focus();
  await keyboard.press('2');
  await keyboard.press('r');
  await keyboard.press('g');
  check(await seed.evaluate((field) => field === document.activeElement), 'G took the focus');
  await seed.blur();
  check(lab.state.controller === 'attractor' && lab.state.tick > 0, 'a key was heard while typing');

  const larger = lab.button('Larger');
  await larger.focus();
  await keyboard.press('?');
  const help = page.getByRole('dialog', { name: 'Keyboard' });
  await help.waitFor();
  check(await help.getByText('take the bead, let it go').isVisible(), "no word of the workspace's");
  await lab.screenshot('keyboard');
  await keyboard.press('r');
  await keyboard.press('Escape');
  await help.waitFor({ state: 'hidden' });
  check(lab.state.tick > 0, 'the dialog let a key through');
  check(await larger.evaluate((one) => one === document.activeElement), 'the focus did not return');
  await keyboard.press('g');
  check(await lab.canvas.evaluate((one) => one === document.activeElement), 'G went elsewhere');
  await keyboard.press('r');
  await until('the start', () => lab.state.tick === 0);

  // One can do without.
  await lab.button('Keyboard shortcuts').click();
  await help.getByRole('checkbox').uncheck();
  await keyboard.press('Escape');
  await keyboard.press('.');
  await lab.button('Step').click();
  await until('one tick only', () => lab.state.tick === 1);
  await lab.button('Keyboard shortcuts').click();
  await help.getByRole('checkbox').check();
  await help.getByRole('button', { name: 'Close' }).click();
}

export async function saysWhatHappens({ lab, browser, server }) {
  await lab.reset();
  const said = await lab.page.evaluateHandle(() => {
    const region = document.querySelector('[data-testid=live-region]');
    const texts = [];
    new MutationObserver(() => {
      texts.push([performance.now(), region.textContent.trim()]);
    }).observe(region, { characterData: true, childList: true, subtree: true });
    return texts;
  });
  const second = await Lab.open(browser, server.url);
  await lab.button('Disturb').click();
  await lab.page.getByLabel('Strength of the kick in mN·s').fill('0.8');
  await lab.run();
  for (let i = 0; i < 3; i++) await lab.button('Kick now').click();
  await until('the kicks', () => lab.state.disturbances >= 3);
  await lab.pause();
  await lab.button('Disturb').click();
  await lab.button('Release control').click();
  await until('the role', async () =>
    (await said.jsonValue()).some(([, text]) => text === 'You are watching.'),
  );
  await lab.button('Take control').click();
  await until('the other role', async () =>
    (await said.jsonValue()).some(([, text]) => text === 'You have control.'),
  );
  const texts = await said.jsonValue();
  check(
    texts.some(([, text]) => text.includes('a kick of 0.80 mN·s')),
    `it said ${JSON.stringify(texts)}`,
  );
  texts.forEach(([at], index) => {
    const before = texts[index - 1]?.[0] ?? -Infinity;
    // The times are of when it was heard, and a busy page hears late.
    check(at - before > 700, `two things within ${at - before} ms`);
  });
  check((await lab.page.getByRole('log').getAttribute('aria-live')) === 'off', 'two voices');
  await second.page.close();
}
