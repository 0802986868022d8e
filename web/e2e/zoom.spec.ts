// Zoom and pan of the plan by mouse and keys.

import { type Lab, expect, test } from './fixtures';
import { distance } from './support/table';
import { until } from './support/wait';

async function scaleOf(lab: Lab) {
  await expect(lab.canvas).toHaveAttribute('data-px-per-m');
  return Number(await lab.canvas.getAttribute('data-px-per-m'));
}

test('zooms at the pointer, moves the plan, and still sets goals', async ({ lab }) => {
  const { mouse } = lab.page;
  const whole = await scaleOf(lab);
  const [goal] = lab.freePoints(await lab.bead(), 0.1, 0.2);
  const before = await lab.px(goal);
  await mouse.move(...before);
  await mouse.wheel(0, -600);
  await expect.poll(() => scaleOf(lab)).toBeGreaterThan(2 * whole);
  const zoomed = await lab.px(goal);
  expect(distance(zoomed, before), 'the place under the pointer moved').toBeLessThan(2);

  // A drag beside the bead moves the plan, and sets no goal.
  await mouse.down();
  await mouse.move(before[0] + 60, before[1] + 30, { steps: 4 });
  await mouse.up();
  const moved = await lab.px(goal);
  expect(distance(moved, [before[0] + 60, before[1] + 30])).toBeLessThan(14);
  expect(lab.state.goal_m).toBeNull();

  await lab.click(goal);
  const set = await until('the goal', () => lab.state.goal_m);
  expect(distance(set, goal)).toBeLessThan(0.002);

  await lab.canvas.press('Home');
  expect(await scaleOf(lab)).toBe(whole);
  await lab.canvas.press('+');
  await expect.poll(() => scaleOf(lab)).toBeGreaterThan(whole);
  await lab.map('colon');
  await expect(lab.button('Fit')).toHaveCount(0);
});

test('in a small window the wheel scrolls the page, and with Ctrl it zooms', async ({ lab }) => {
  const { page } = lab;
  const { mouse, keyboard } = page;
  const scrolled = () => page.evaluate(() => window.scrollY);
  const large = await scaleOf(lab);
  await page.setViewportSize({ width: 900, height: 700 });
  await expect.poll(() => scaleOf(lab)).not.toBe(large);
  const { x, y, width, height } = await lab.boxOf(lab.canvas);
  const whole = await scaleOf(lab);
  const start = await scrolled();
  await mouse.move(x + width / 2, y + height / 2);
  await mouse.wheel(0, 40);
  await expect.poll(scrolled).toBe(start + 40);
  expect(await scaleOf(lab), 'the plan zoomed').toBe(whole);
  await keyboard.down('Control');
  await mouse.wheel(0, -600);
  await keyboard.up('Control');
  await expect.poll(() => scaleOf(lab)).toBeGreaterThan(2 * whole);
  expect(await scrolled(), 'the page scrolled, too').toBe(start + 40);
});
