// Details that visitors stumbled over.

import type { Locator } from '@playwright/test';
import { Lab, expect, test } from './fixtures';
import { SECOND_TICKS } from './support/stepper';
import { must, until } from './support/wait';

const eventsOf = (lab: Lab) => lab.page.getByRole('button', { name: /^Why: / });

/** Delivers to a goal near by. */
async function deliver(lab: Lab) {
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.15, 0.25)[0]);
  await lab.deliver();
}

test('draws the whole course long after the delivery', async ({ lab }) => {
  const start = await lab.bead();
  await deliver(lab);
  await lab.step(80 * SECOND_TICKS);
  const end = await lab.bead();
  // A point of the course, away from bead and goal.
  const middle: [number, number] = [(start[0] + end[0]) / 2, (start[1] + end[1]) / 2];
  const pixels = () => lab.pixelsAround(start, middle);
  let withTrail = await pixels();
  await until('a picture at rest', async () => {
    const before = withTrail;
    await lab.drawn();
    withTrail = await pixels();
    return withTrail === before;
  });
  await lab.layer('Trails', false);
  await until('no trail', async () => (await pixels()) !== withTrail);
  await lab.layer('Trails');
  await until('the trail', async () => (await pixels()) === withTrail);
});

test('the story of an event does not cover the bead', async ({ lab }) => {
  await deliver(lab);
  await lab.panel('Story');
  await eventsOf(lab).last().click();
  const card = must(await lab.page.getByRole('dialog').boundingBox(), 'the card');
  for (const point of [await lab.bead(), must(await lab.goal(), 'the goal')]) {
    const [x, y] = await lab.px(point);
    const inside = x > card.x && x < card.x + card.width && y > card.y && y < card.y + card.height;
    expect(inside, `the card covers (${x}, ${y})`).toBe(false);
  }
});

test('with forced colours, selected tabs, sliders and the timeline are visible', async ({
  lab,
}) => {
  await lab.page.emulateMedia({ forcedColors: 'active' });
  const lineOf = (name: string) =>
    lab.tab(name).evaluate((tab) => getComputedStyle(tab, '::after').borderBottom);
  expect(await lineOf('Now')).toMatch(/^2px solid/);
  expect(await lineOf('Learn')).not.toMatch(/^2px solid/);
  const borderOf = (one: Locator) => one.evaluate((node) => getComputedStyle(node).borderColor);
  const segment = (name: string) => lab.page.locator('.segmented label', { has: lab.radio(name) });
  for (const [chosen, other] of [
    [lab.view('Lab'), lab.view('Draw')],
    [segment('Attractor'), segment('RL')],
  ] as const) {
    expect(await borderOf(chosen)).not.toBe(await borderOf(other));
  }
  const pageColor = await lab.page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  for (const slider of [lab.page.getByRole('slider').first(), lab.label('Timeline')]) {
    const picture = await slider.screenshot();
    const colors = await lab.page.evaluate(
      async (bytes) => {
        const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const ctx = canvas.getContext('2d');
        ctx?.drawImage(bitmap, 0, 0);
        const data = ctx?.getImageData(0, 0, bitmap.width, bitmap.height).data ?? [];
        const seen = new Set<string>();
        for (let i = 0; i < data.length; i += 4) {
          seen.add(`rgb(${String(data[i])}, ${String(data[i + 1])}, ${String(data[i + 2])})`);
        }
        return [...seen];
      },
      [...picture],
    );
    expect(colors.filter((color) => color !== pageColor).length).toBeGreaterThan(0);
  }
});
