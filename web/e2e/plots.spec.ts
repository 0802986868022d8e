// The lanes of plots: the values that each part shows, which parts there are, and saving as CSV, PNG and SVG.

import { readFile } from 'node:fs/promises';
import { type Lab, expect, test } from './fixtures';
import { must, until } from './support/wait';

/** Between two points of the server's course. */
const COURSE_TICKS = 5;
const PARTS = ['e', 'a', 'b'];

const pictureOf = (lab: Lab, part: string) => lab.page.locator(`[data-part=${part}] [role=img]`);

async function textOf(lab: Lab, part: string) {
  return must(await pictureOf(lab, part).getAttribute('aria-label'), part);
}

/** Shows the lanes. A reload keeps them. */
async function showLanes(lab: Lab) {
  const button = lab.button('Plots');
  if ((await button.getAttribute('aria-pressed')) === 'false') await button.click();
}

async function openMenu(lab: Lab) {
  const button = lab.button('More about plots');
  if ((await button.getAttribute('aria-expanded')) === 'false') await button.click();
}

async function saved(lab: Lab, kind: 'CSV' | 'PNG' | 'SVG') {
  await openMenu(lab);
  const [file] = await Promise.all([
    lab.page.waitForEvent('download'),
    lab.button(`Save ${kind}`).click(),
  ]);
  return { name: file.suggestedFilename(), bytes: await readFile(await file.path()) };
}

async function csvRows(lab: Lab) {
  return (await saved(lab, 'CSV')).bytes.toString().trim().split('\n');
}

test("plots the paper's figure, and saves it", async ({ lab }) => {
  const { page } = lab;
  await showLanes(lab);
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.25, 0.4)[0]);
  // In small steps: the plots have a point for each state that comes.
  await lab.stepUntil('four seconds', () => lab.state.sim_time_s > 4, 10);
  for (const part of PARTS) await expect(pictureOf(lab, part)).toHaveAttribute('aria-label', /\d/);

  // With the pointer over one part, all parts show the values of the same moment.
  const box = await lab.boxOf(page.locator('[data-part=e] .plot-area'));
  const last = await textOf(lab, 'a');
  await page.mouse.move(box.x + 0.1 * box.width, box.y + box.height / 2);
  await expect(pictureOf(lab, 'a')).not.toHaveAttribute('aria-label', last);
  const moment = must(/at ([\d.:]+ s)/.exec(await textOf(lab, 'e'))?.[1], 'the moment');
  for (const part of ['a', 'b']) expect(await textOf(lab, part)).toContain(`at ${moment}`);
  await page.mouse.move(0, 0);

  // Large plots are higher, and the map keeps its scale.
  const map = page.locator('.map-box');
  const before = await lab.boxOf(map);
  await openMenu(lab);
  await page.getByRole('checkbox', { name: 'Large plots' }).check();
  await expect
    .poll(async () => (await lab.boxOf(page.locator('[data-part=e]'))).height)
    .toBeGreaterThan(2 * box.height);
  expect((await lab.boxOf(map)).height).toBe(before.height);
  await page.getByRole('checkbox', { name: 'Large plots' }).uncheck();

  // There is room for three; another one takes the place of the one that was chosen first.
  await openMenu(lab);
  await page.getByRole('checkbox', { name: 'Error x' }).check();
  await expect(pictureOf(lab, 'c')).toHaveAttribute('aria-label', /at \d/);
  await expect(page.locator('.lane')).toHaveCount(3);
  await expect(page.getByRole('checkbox', { name: 'y', exact: true })).not.toBeChecked();

  // Going back keeps the later rows until the session runs again.
  const all = await csvRows(lab);
  expect(all[0]).toMatch(/^tick,sim_time_s,tool_x_m/);
  const end = lab.state.tick;
  const track = await lab.boxOf(page.getByLabel('Timeline'));
  await page.mouse.click(track.x + 0.3 * track.width, track.y + track.height / 2);
  await until('an earlier tick', () => lab.state.tick < end / 2);
  expect((await csvRows(lab)).length).toBe(all.length);

  const svg = await saved(lab, 'SVG');
  expect(svg.name).toMatch(/\.svg$/);
  expect(svg.bytes.toString()).toContain('(f) Locus');
  const png = await saved(lab, 'PNG');
  expect(png.bytes.subarray(1, 4).toString()).toBe('PNG');

  await page.keyboard.press('Escape');
  await page.keyboard.press('p');
  await expect(page.locator('.lane')).toHaveCount(0);
});

test('has the course from the start without gaps, also after a reload and a step back', async ({
  lab,
}) => {
  const { page } = lab;
  const ticks = async () => {
    await showLanes(lab);
    const [, ...rows] = await csvRows(lab);
    return rows.map((row) => Number(row.split(',')[0]));
  };
  const faults = async (end: number) => {
    const known = [0, ...(await ticks())];
    const gaps = known.flatMap((tick, index) => {
      const next = known[index + 1] ?? tick;
      return next - tick > COURSE_TICKS ? [`${tick} to ${next}`] : [];
    });
    return known.at(-1) === end ? gaps : [...gaps, `it ends at ${known.at(-1)}`];
  };
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.25, 0.4)[0]);
  // The page gets few of these states.
  await lab.step(500);
  const end = lab.state.tick;
  expect(await faults(end)).toEqual([]);
  await page.reload();
  await lab.live();
  expect(await faults(end)).toEqual([]);
  await lab.send({ type: 'rewind', tick: 250 });
  await until('an earlier tick', () => lab.state.tick === 250);
  await page.reload();
  await lab.live();
  expect(await faults(end), 'up to the newest tick').toEqual([]);
});
