// The first visit: the scenario that a session opens with, and one tip at a time.

import type { Page } from '@playwright/test';
import { Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { freePointNearBead } from './support/preconditions';
import { CONTROL_STEP_TICKS } from './support/stepper';
import { Server } from './support/server';
import { must, until } from './support/wait';

const NO_GOAL = 'No goal is set';
const tip = (page: Page) => page.locator('.tip span');
const isTip = (page: Page, words: string | RegExp) => expect(tip(page)).toHaveText(words);

test('opens on a goal in the colon, with a tip', async ({ page, watch }) => {
  const server = await Server.start({ scenario: 'opening' });
  try {
    watch.allowHost(server.url);
    const lab = await Lab.attach(page, server.url);
    expect(lab.scene.map).toBe('colon');
    expect(lab.state.controller).toBe('rl');
    expect(lab.state.running).toBe(false);
    expect(await lab.point('goal')).toBeDefined();
    await isTip(page, 'Press Run, then drag the bead away.');
    expect(await violations(page)).toEqual([]);
    await lab.run();
    await until('transport', () => lab.state.phase === 'transporting');
    await page.goto('about:blank');
  } finally {
    await server.stop();
  }
});

test('shows one tip at a time, and none twice', async ({ page, session }) => {
  const lab = await Lab.attach(page, session.url);
  // Without a goal, nothing would move.
  await isTip(page, 'Click a free place to set the goal.');
  await lab.setGoal(freePointNearBead(lab));
  await isTip(page, /^Press Run/);
  await lab.run();
  await isTip(page, /^Drag the bead/);
  // A later tip can be done first.
  await lab.controller('ERRT');
  await isTip(page, /^Drag the bead/);
  await lab.pause();
  await lab.deliver();
  // As far as the magnet does not reach.
  await lab.startDrag(must(lab.freePoints(lab.state.bead_m, 0.2, 0.35)[0], 'a place far away'));
  await lab.stepUntil('a lost bead', () => lab.state.mode === 1, CONTROL_STEP_TICKS);
  await isTip(page, /^Choose 3-D/);
  await page.mouse.up();
  await page.reload();
  await lab.live();
  await isTip(page, /^Choose 3-D/);
  await lab.radio('3-D').check();
  await expect(tip(page)).toHaveCount(0);
  await lab.radio('Plan').check();
  await lab.drawn();
  await expect(tip(page)).toHaveCount(0);
});

test('does not ask for what is so already', async ({ page, session, openLab }) => {
  const first = await openLab();
  await first.setGoal(freePointNearBead(first));
  await first.run();
  await first.releaseControl();
  // Free control goes to the next browser that connects.
  const lab = await Lab.attach(page, session.url);
  await lab.isRole('operator');
  await isTip(page, /^Drag the bead/);
});

test('skips all tips', async ({ page, session }) => {
  const lab = await Lab.attach(page, session.url);
  expect(faultsOf(await controls(page), MIN_SIDE_PX.mouse)).toEqual([]);
  await lab.button('Skip tips').press('Enter');
  await expect(tip(page)).toHaveCount(0);
  await page.reload();
  await lab.live();
  await expect(tip(page)).toHaveCount(0);
});

test('asks for a goal when it runs without one, by key and by button', async ({ lab }) => {
  const notice = lab.notice('workspace');
  await lab.page.getByRole('heading', { name: 'Workspace' }).click();
  await lab.page.keyboard.press(' ');
  await expect(notice).toContainText(NO_GOAL);
  await lab.setGoal(freePointNearBead(lab));
  await expect(notice).toHaveCount(0);
  await lab.pause();
  await lab.run();
  await lab.drawn();
  await expect(notice).toHaveCount(0);
  await lab.pause();
  await lab.button('Clear goal').click();
  await until('no goal', () => !lab.state.goal_m);
  await lab.run();
  await expect(notice).toContainText(NO_GOAL);
});
