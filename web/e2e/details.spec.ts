// Details that visitors stumbled over.

import { Lab, expect, test } from './fixtures';
import { SECOND_TICKS } from './support/stepper';
import { must, until } from './support/wait';

const LARGEST_SEED = Number.MAX_SAFE_INTEGER;
const PHONE = { width: 390, height: 844 };
const ACHIEVED = /"speed_achieved":[\d.]+/;
const LESSON = /^The law to the letter/;

const eventsOf = (lab: Lab) => lab.page.getByRole('button', { name: /^Why: / });
const barOf = (lab: Lab) => lab.page.getByRole('region', { name: 'Playback' });

/** Delivers to a goal near by. */
async function deliver(lab: Lab) {
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.15, 0.25)[0]);
  await lab.deliver();
}

test('the scale of the gauge is fixed, so that T moves', async ({ lab }) => {
  const mark = lab.page.locator('.gauge .mark');
  const at = async (threshold_cm: string) => {
    await lab.tune('Threshold T', threshold_cm);
    await until('T', () => lab.scene.parameters.threshold_m === Number(threshold_cm) / 100);
    await lab.drawn();
    return Number(/^M([\d.]+)/.exec((await mark.getAttribute('d')) ?? '')?.[1]);
  };
  const [five, ten, twenty] = [await at('5'), await at('10'), await at('20')];
  expect(ten).toBeGreaterThan(five);
  expect(twenty - ten).toBeCloseTo(2 * (ten - five), 3);
});

test('shows a long seed as a whole', async ({ lab }) => {
  const seed = lab.label('Seed');
  await seed.fill(String(LARGEST_SEED));
  await seed.press('Enter');
  await until('the seed', () => lab.scene.seed === LARGEST_SEED);
  await expect(seed).toHaveValue(String(LARGEST_SEED));
  const cut_px = () =>
    seed.evaluate((input: HTMLInputElement) => input.scrollWidth - input.clientWidth);
  await expect.poll(cut_px).toBeLessThanOrEqual(0);
});

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

test('a machine at its limit is said quietly, with an explanation', async ({ page, session }) => {
  // The server says that it reaches a quarter of the speed, whatever it reaches.
  await page.routeWebSocket(/\/live$/, (socket) => {
    const server = socket.connectToServer();
    server.onMessage((message) => {
      const isText = typeof message === 'string';
      socket.send(isText ? message.replace(ACHIEVED, '"speed_achieved":16') : message);
    });
  });
  const lab = await Lab.attach(page, session.url);
  await lab.speed('64');
  await lab.run();
  const limit = lab.page.getByTestId('achieved').getByText('machine limit');
  await expect(limit).toHaveAttribute('title', /The result of the trial is the same/);
  const color = (element: Element) => getComputedStyle(element).color;
  const muted = await lab.page.getByText('Simulation, not safety-rated').evaluate(color);
  expect(await limit.evaluate(color)).toBe(muted);
  await lab.pause();
});

test('the event list is one stop of the Tab key', async ({ lab }) => {
  await deliver(lab);
  const events = eventsOf(lab);
  const count = await events.count();
  expect(count).toBeGreaterThan(2);
  const stops = () =>
    events.evaluateAll((all) => all.filter((one) => one.getAttribute('tabindex') === '0').length);
  expect(await stops()).toBe(1);
  await events.last().focus();
  await lab.page.keyboard.press('ArrowUp');
  await expect(events.nth(count - 2)).toBeFocused();
  await lab.page.keyboard.press('Home');
  await expect(events.first()).toBeFocused();
  expect(await stops()).toBe(1);
});

test('the story of an event does not cover the bead', async ({ lab }) => {
  await deliver(lab);
  await eventsOf(lab).last().click();
  const card = must(await lab.page.getByRole('dialog').boundingBox(), 'the card');
  for (const point of [await lab.bead(), must(await lab.point('goal'), 'the goal')]) {
    const [x, y] = await lab.px(point);
    const inside = x > card.x && x < card.x + card.width && y > card.y && y < card.y + card.height;
    expect(inside, `the card covers (${x}, ${y})`).toBe(false);
  }
});

test('the settings of a lesson end with it', async ({ lab }) => {
  await lab.tab('Lessons').click();
  await lab.page.getByRole('button', { name: LESSON }).click();
  await lab.page.getByRole('tabpanel').getByRole('radio').first().check();
  await lab.page.getByRole('tabpanel').getByRole('button', { name: 'Next' }).click();
  await lab.button('Set it up').click();
  await until('its law', () => lab.scene.parameters.switching_law === 'literal');
  await lab.drawn();
  await lab.page.getByRole('button', { name: 'All lessons' }).click();
  await until('the defaults', () => lab.scene.parameters.switching_law === 'hysteresis');
  expect(lab.scene.parameters).toEqual(lab.scene.defaults);
});

test('on a phone, the playback bar is one row until it is opened', async ({ lab }) => {
  await lab.page.setViewportSize(PHONE);
  const width_px = () => lab.page.evaluate(() => document.documentElement.scrollWidth);
  await expect.poll(width_px).toBeLessThanOrEqual(PHONE.width);
  const height_px = async () => must(await barOf(lab).boundingBox(), 'the bar').height;
  await expect.poll(height_px).toBeLessThan(110);
  await expect(lab.label('Speed')).toBeHidden();
  await lab.button('More').click();
  await expect(lab.label('Speed')).toBeVisible();
  await lab.button('More').click();
  await expect.poll(height_px).toBeLessThan(110);
  // No blank space below the panels.
  await lab.page.evaluate(() => {
    scrollTo(0, document.documentElement.scrollHeight);
  });
  const bar = must(await barOf(lab).boundingBox(), 'the bar');
  expect(bar.y + bar.height).toBeCloseTo(PHONE.height, 0);
  const last = must(await lab.page.locator('main > .panel').last().boundingBox(), 'the last panel');
  expect(bar.y - (last.y + last.height)).toBeLessThan(24);
});

test('with forced colours, selected tabs, sliders and the timeline are visible', async ({
  lab,
}) => {
  await lab.page.emulateMedia({ forcedColors: 'active' });
  const borderOf = (name: string) =>
    lab.tab(name).evaluate((tab) => getComputedStyle(tab).borderBottomColor);
  expect(await borderOf('Events')).not.toBe(await borderOf('Lessons'));
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
