// The laboratory: goals, disturbances, parameters, layers, time.

import { expect, test } from './fixtures';
import { Server } from './support/server';
import { distance, distanceToSegment } from './support/table';
import { must, until } from './support/wait';

/** Comfortably more than the default threshold of the switching law. */
const LOST_M = 0.14;
const SAFETY = /simulation, not safety-rated/i;

test('opens as the operator, paused', async ({ lab }) => {
  await lab.isRole('operator');
  await expect(lab.button('Run')).toBeVisible();
  await expect(lab.page.getByText(SAFETY)).toBeVisible();
  const unnamed = await lab.page.locator('button, input, select, canvas').evaluateAll((all) =>
    all
      .filter((one) => {
        const labels = (one as HTMLInputElement).labels as NodeListOf<Element> | null | undefined;
        const label = one.getAttribute('aria-label') ?? labels?.[0]?.textContent;
        // A plot is one picture; its parts have no name.
        return !(label ?? one.textContent).trim() && !one.closest('[role=img]');
      })
      .map((one) => one.outerHTML),
  );
  expect(unnamed, 'without an accessible name').toEqual([]);
});

test('delivers the bead to a clicked goal', async ({ lab }) => {
  await lab.reset({ speed: '8' });
  const [goal] = lab.freePoints(await lab.bead(), 0.2, 0.3);
  await lab.click(goal);
  await expect(lab.canvas).toHaveAttribute('data-goal', /\d/);
  expect(distance(must(await lab.point('goal'), 'the goal'), goal)).toBeLessThan(0.002);
  await lab.run();
  await lab.delivered(1);
});

test('recovers when the mouse drags the bead away', async ({ lab }) => {
  await lab.reset();
  const [goal] = lab.freePoints(await lab.bead(), 0.3, 0.5);
  await lab.setGoal(goal);
  await lab.run();
  await expect(lab.page.getByTestId('phase')).toHaveText('transporting');
  // Every text that the mode badge shows from now on.
  const modes = await lab.page.getByTestId('mode').evaluateHandle((badge) => {
    const seen = [badge.textContent];
    new MutationObserver(() => seen.push(badge.textContent)).observe(badge, {
      characterData: true,
      childList: true,
      subtree: true,
    });
    return seen;
  });
  // While paused, the bead does not leave the pointer, however slow this machine is.
  const { mouse, keyboard } = lab.page;
  await keyboard.press(' ');
  await until('a pause', () => !lab.state.running);

  const bead = await lab.bead();
  // Off the path to the goal: a bead dragged along it on a slow machine would never be lost.
  const away = must(
    lab.freePoints(bead, 0.15, 0.3).find((point) => distanceToSegment(point, bead, goal) > LOST_M),
    'a free point off the path',
  );
  await lab.pull(away);
  await keyboard.press(' ');
  await until('the bead at the hand', async () => distance(await lab.bead(), away) < 0.01);
  await mouse.up();

  await expect
    .poll(async () => (await modes.jsonValue()).join(''), { message: 'both switches' })
    .toContain('212');
  await lab.speed('8');
  await lab.delivered(1);
  await expect(lab.page.getByTestId('disturbances')).toHaveText('1');
});

test('refuses a goal in a wall, beside it', async ({ lab }) => {
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
  const goal = await lab.point('goal');
  await lab.click(lab.wallPoint());
  await lab.notice('workspace').waitFor();
  expect(await lab.point('goal')).toEqual(goal);
});

test('obeys the keyboard', async ({ lab }) => {
  await lab.canvas.focus();
  const { keyboard } = lab.page;
  const bead = await lab.bead();
  const [aim] = lab.freePoints(bead, 0.04, 0.12);
  for (const [delta, back, forth] of [
    [aim[0] - bead[0], 'ArrowLeft', 'ArrowRight'],
    [aim[1] - bead[1], 'ArrowDown', 'ArrowUp'],
  ] as const) {
    const presses = Math.max(1, Math.round(Math.abs(delta) / 0.005));
    for (let i = 0; i < presses; i++) await keyboard.press(delta < 0 ? back : forth);
  }
  await keyboard.press('Enter');
  const goal = await until('a goal', () => lab.point('goal'));
  expect(distance(goal, aim)).toBeLessThan(0.01);

  await keyboard.press(' ');
  await until('running', () => lab.state.running);
  // A key that is held takes once.
  await keyboard.down('d');
  await until('the hand', () => lab.state.hand_m);
  for (let i = 0; i < 3; i++) await keyboard.down('d');
  await keyboard.up('d');
  await lab.later(40);
  expect(lab.state.hand_m, 'the held key released the bead').not.toBeNull();
  await keyboard.press('Escape');
  await until('no hand', () => !lab.state.hand_m);
  await keyboard.press(' ');
  await until('paused', () => !lab.state.running);
});

test('changes a parameter from the form, and the form from the defaults', async ({ lab }) => {
  const threshold = lab.spin('Threshold T');
  await lab.tune('Threshold T', '8');
  await until('T = 8 cm', () => lab.scene.parameters.threshold_m === 0.08);
  // A slider that goes back to where it was leaves nothing behind.
  const slider = lab.page.getByRole('slider', { name: 'Threshold T slider' });
  await expect(threshold).toHaveValue('8.0');
  const box = await lab.boxOf(slider);
  const { min, max } = await slider.evaluate((one: HTMLInputElement) => ({
    min: Number(one.min),
    max: Number(one.max),
  }));
  const at = box.x + 8 + ((8 - min) / (max - min)) * (box.width - 16);
  const y = box.y + box.height / 2;
  const { mouse } = lab.page;
  await mouse.move(at, y);
  await mouse.down();
  await mouse.move(at + 40, y, { steps: 4 });
  await expect(threshold).not.toHaveValue('8.0');
  await mouse.move(at, y, { steps: 4 });
  await mouse.up();
  await expect(threshold).toHaveValue('8.0');
  await lab.restoreDefaults();
  await expect(threshold).toHaveValue('10.0');
});

test('kicks the bead', async ({ lab }) => {
  const bead = await lab.bead();
  await lab.run();
  await lab.button('Disturb').click();
  await lab.page.getByLabel('Direction of kick and push').selectOption('right');
  const strength = lab.page.getByLabel('Strength of the kick in mN·s');
  await strength.fill('0.8');
  await strength.press('Enter');
  await until('a moved bead', () => lab.state.bead_m[0] - bead[0] > 0.02);
  await expect(lab.page.getByTestId('disturbances')).toHaveText('1');
  await expect(lab.page.getByRole('log').getByText(/a kick of 0\.80 mN·s/)).toBeVisible();
});

test('goes back in time', async ({ lab }) => {
  await lab.speed('8');
  await lab.run();
  await until('three seconds', () => lab.state.sim_time_s > 3);
  await lab.pause();
  const end = lab.state.tick;
  const timeline = lab.page.getByLabel('Timeline');
  const thumb = async () => Number(await timeline.inputValue());
  const box = await lab.boxOf(timeline);
  const y = box.y + box.height / 2;
  const { keyboard, mouse } = lab.page;
  await mouse.click(box.x + 0.4 * box.width, y);
  await until('an earlier tick', () => lab.state.tick < 0.6 * end);
  const earlier = lab.state.tick;

  // By keyboard from one control step to the next, both ways.
  await timeline.focus();
  await keyboard.press('ArrowRight');
  const next = await until('the next step', () => lab.state.tick > earlier && lab.state.tick);
  expect([31, 32]).toContain(next - earlier);
  await expect.poll(thumb).toBe(next);
  await keyboard.press('ArrowLeft');
  await until('the step before', () => lab.state.tick === earlier);
  await expect.poll(thumb).toBe(earlier);

  // Away and back to where it began: after that, the thumb follows time again.
  const share = await timeline.evaluate(
    (one: HTMLInputElement) =>
      (one.valueAsNumber - Number(one.min)) / (Number(one.max) - Number(one.min)),
  );
  const at = box.x + 8 + share * (box.width - 16);
  await mouse.move(at, y);
  await mouse.down();
  await mouse.move(at - 60, y, { steps: 4 });
  await until('a tick before', () => lab.state.tick < earlier);
  await mouse.move(at, y, { steps: 4 });
  await mouse.up();
  await until('the tick again', () => Math.abs(lab.state.tick - earlier) <= 1);
  await until('the thumb there', async () => (await thumb()) === lab.state.tick);
  const { tick } = lab.state;
  await lab.button('Step').click();
  await until('one tick', () => lab.state.tick === tick + 1);
  await expect.poll(thumb).toBe(tick + 1);
});

test('keeps time', async ({ lab }) => {
  await lab.button('Step ¼ s').click();
  await expect(lab.page.getByTestId('tick')).toHaveText('tick 32');
  await lab.button('Step ¼ s').click();
  await until('the next', () => lab.state.tick === 63);
  await lab.speed('64');
  await lab.run();
  const achieved = lab.page.locator('.achieved');
  await until('what is achieved', async () => {
    const text = await achieved.innerText();
    const [factor] = /[\d.]+/.exec(text) ?? [];
    // It says so only where less is achieved than requested.
    return factor && text.includes('machine limit') === Number(factor) < 54.4;
  });
});

test('reports that the server has ended', async ({ openLab, watch }) => {
  const server = await Server.start();
  watch.allowHost(server.url);
  watch.allow(/ERR_CONNECTION_REFUSED|WebSocket/);
  const lab = await openLab({ url: server.url });
  await server.kill();
  await expect(lab.page.getByTestId('connection')).toHaveText(/^reconnecting/);
  await expect(lab.button('Run')).toBeDisabled();
});
