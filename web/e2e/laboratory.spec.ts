// The laboratory: goals, the bead by mouse and by keyboard, kicks and the timeline.
// More tests of dragging the bead are in gestures.spec.ts and holds.spec.ts.

import { expect, test } from './fixtures';
import { CONTROL_STEP_TICKS, SECOND_TICKS } from './support/stepper';
import { distance, distanceToSegment } from './support/table';
import { must, until } from './support/wait';

/** More than the default threshold T of 10 cm. */
const LOST_M = 0.14;

test('delivers the bead to a clicked goal', async ({ lab }) => {
  await lab.reset();
  const [goal] = lab.freePoints(await lab.bead(), 0.2, 0.3);
  await lab.click(goal);
  const set = await until('a goal', () => lab.goal());
  expect(distance(set, goal)).toBeLessThan(0.002);
  await lab.deliver();
  await expect(lab.page.locator('.status-words')).toContainText('Delivered');
});

test('fetches the bead after a drag by mouse, and delivers it', async ({ lab }) => {
  await lab.reset();
  const [goal] = lab.freePoints(await lab.bead(), 0.3, 0.5);
  await lab.setGoal(goal);
  await lab.stepUntil('transport', () => lab.state.leg_steps > 4, CONTROL_STEP_TICKS);
  const law = lab.page.getByRole('list', { name: /^Switching law/ });
  await expect(law).toHaveAccessibleName('Switching law: sub-controller 2 is active');
  // Records every sub-controller that the panel shows as active from now on.
  const modes = await law.evaluateHandle((list) => {
    const active = () => list.querySelector('[data-active=true]')?.getAttribute('data-mode') ?? '';
    const shown = [active()];
    new MutationObserver(() => shown.push(active())).observe(list, {
      attributeFilter: ['aria-label'],
    });
    return shown;
  });
  const bead = await lab.bead();
  // Off the path to the goal: along it, the tool would not lose the bead.
  const away = must(
    lab.freePoints(bead, 0.15, 0.3).find((point) => distanceToSegment(point, bead, goal) > LOST_M),
    'a free point off the path',
  );
  await lab.startDrag(away);
  await lab.stepUntil('the bead at the hand', () => distance(lab.state.bead_m, away) < 0.01, 25);
  await lab.page.mouse.up();
  await until('no hand', () => !lab.state.hand_m);

  const shown = async () => {
    // A slow page would skip the short time of sub-controller 1.
    await lab.drawn();
    return (await modes.jsonValue()).join('');
  };
  await lab.stepUntil('both switches', async () => /21+2/.test(await shown()), 25);
  await lab.deliver();
  await expect(lab.page.getByTestId('disturbances')).toHaveText('1');
});

test('places a goal, runs, drags the bead and pauses by keyboard', async ({ lab }) => {
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
  const goal = await until('a goal', () => lab.goal());
  expect(distance(goal, aim)).toBeLessThan(0.01);

  await keyboard.press(' ');
  await until('running', () => lab.state.running);
  // A held key repeats, but takes the bead only once.
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

test('kicks the bead', async ({ lab }) => {
  const bead = await lab.bead();
  await lab.button('Disturb').click();
  await lab.page.getByLabel('Direction of kick and push').selectOption('right');
  const strength = lab.page.getByLabel('Strength of the kick in mN·s');
  await strength.fill('0.8');
  await strength.press('Enter');
  await lab.stepUntil('a moved bead', () => lab.state.bead_m[0] - bead[0] > 0.02, 25);
  await expect(lab.page.getByTestId('disturbances')).toHaveText('1');
  await lab.panel('Story');
  await expect(lab.page.getByRole('log').getByText(/a kick of 0\.80 mN·s/)).toBeVisible();
});

test('goes back in time by mouse and by keyboard', async ({ lab }) => {
  await lab.step(3 * SECOND_TICKS);
  const end = lab.state.tick;
  const timeline = lab.page.getByLabel('Timeline');
  const thumb = async () => Number(await timeline.inputValue());
  const box = await lab.boxOf(timeline);
  const y = box.y + box.height / 2;
  const { keyboard, mouse } = lab.page;
  await mouse.click(box.x + 0.4 * box.width, y);
  await until('an earlier tick', () => lab.state.tick < 0.6 * end);
  const earlier = lab.state.tick;

  // An arrow key moves by one control step, in both directions.
  await timeline.focus();
  await keyboard.press('ArrowRight');
  const next = await until(
    'the next control step',
    () => lab.state.tick > earlier && lab.state.tick,
  );
  expect([31, 32]).toContain(next - earlier);
  await expect.poll(thumb).toBe(next);
  await keyboard.press('ArrowLeft');
  await until('the previous control step', () => lab.state.tick === earlier);
  await expect.poll(thumb).toBe(earlier);

  // Drags the thumb away and back to its start. After that it follows the tick again.
  const share = await timeline.evaluate(
    (one: HTMLInputElement) =>
      (one.valueAsNumber - Number(one.min)) / (Number(one.max) - Number(one.min)),
  );
  const at = box.x + 8 + share * (box.width - 16);
  await mouse.move(at, y);
  await mouse.down();
  await mouse.move(at - 60, y, { steps: 4 });
  await until('an earlier tick', () => lab.state.tick < earlier);
  await mouse.move(at, y, { steps: 4 });
  await mouse.up();
  await until('the first tick again', () => Math.abs(lab.state.tick - earlier) <= 1);
  await until('the thumb at this tick', async () => (await thumb()) === lab.state.tick);
  const { tick } = lab.state;
  await lab.button('Step').click();
  await until('one tick', () => lab.state.tick === tick + 1);
  await expect.poll(thumb).toBe(tick + 1);
});
