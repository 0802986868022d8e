// Challenges: played by mouse from a link, explained, and put on the board.

import type { Ghosts } from '../src/net/protocol.gen';
import { type Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { MIN_SIDE_PX, controls, faultsOf } from './support/inventory';
import { SECOND_TICKS } from './support/stepper';
import { type Point, distance } from './support/table';
import { must, until } from './support/wait';

/** One with a short path. */
const NAME = 'easy-e';
const PLAY_MS = 60_000;
/** Samples that the hand is ahead of the nearest one. */
const AHEAD = 4;

const tool = (lab: Lab): Point => [lab.state.tool_m[0], lab.state.tool_m[1]];

/** The way of ERRT's tool, which the hand follows. */
async function errtWay(lab: Lab): Promise<readonly Point[]> {
  const address = new URL(`/api/challenges/${NAME}/ghosts`, lab.page.url()).href;
  const answer = await lab.page.request.get(address);
  const { ghosts } = (await answer.json()) as Ghosts;
  return must(
    ghosts.find(({ controller }) => controller === 'errt'),
    'the ghost of ERRT',
  ).trace.tool_m;
}

/** Points along the way until the attempt is over, with a rest in the middle. */
async function play(lab: Lab, way: readonly Point[], restTicks: number) {
  const { mouse } = lab.page;
  // The first movement of the hand starts the clock.
  await mouse.move(...(await lab.px(tool(lab))));
  await mouse.down();
  await until('the clock', () => lab.state.running && lab.state.tick > 0);
  const px = await Promise.all(way.map((place) => lab.px(place)));
  let nearest = 0;
  let hasRested = false;
  await until(
    'the delivery',
    async () => {
      const off_m = (index: number) => distance(tool(lab), must(way[index], 'a place'));
      for (let i = nearest; i < Math.min(way.length, nearest + 4 * AHEAD); i++) {
        if (off_m(i) < off_m(nearest)) nearest = i;
      }
      if (!hasRested && nearest > way.length / 2) {
        hasRested = true;
        await lab.later(restTicks);
      }
      await mouse.move(...must(px[Math.min(nearest + AHEAD, way.length - 1)], 'a place'));
      return lab.state.attempt?.is_delivered;
    },
    PLAY_MS,
  );
  await mouse.up();
}

test('a challenge from a link is played, explained and put on the board', async ({
  session,
  openLab,
}) => {
  const lab = await openLab({ url: `${session.url}?challenge=${NAME}` });
  const { page } = lab;
  await until('the challenge', () => lab.scene.challenge === NAME);
  await expect(lab.tab('Play')).toHaveAttribute('aria-selected', 'true');
  await expect(lab.setUpButton).toHaveText(/^Challenge\s*Easy · e · posts$/i);
  // Its link is for each player.
  await lab.button('Share').click();
  await expect(page.getByLabel('Link: This challenge')).toHaveValue(
    `${new URL(page.url()).origin}/copy/#challenge=${NAME}`,
  );
  await page.keyboard.press('Escape');
  const way = await errtWay(lab);
  await play(lab, way, 2 * SECOND_TICKS);
  expect(lab.state.running, 'the session pauses').toBe(false);

  const result = page.getByRole('region', { name: 'Result' });
  await expect(result).toContainText('to deliver');
  await expect(result, 'the rest is found').toContainText(/Most time was lost from/);
  const total = must(lab.state.attempt, 'the attempt').total_s.toFixed(1);
  await expect(result).toContainText(`= ${total} s`);

  const faults = faultsOf(await controls(page), MIN_SIDE_PX.mouse);
  expect([...faults, ...(await violations(page))]).toEqual([]);

  const sign = lab.button('Put it on the board');
  await page.getByLabel('Your name').fill('');
  await sign.click();
  await expect(result.getByRole('alert')).toHaveText('Enter your name.');
  await expect(page.getByLabel('Your name')).toBeFocused();
  await page.getByLabel('Your name').fill('Ada');
  await page.getByLabel('Class (if you wish)').fill('7b');
  await sign.click();
  await expect(result).toContainText('Place 1 of 1 on the board.');
  await expect(page.locator('.challenge-board')).toContainText('Ada (7b)');

  // The rewound session shows the moment; the result stays.
  const loss_tick = lab.state.tick;
  await lab.button('Show this moment').click();
  await until('the moment', () => lab.state.tick < loss_tick);
  await expect(result).toContainText(`= ${total} s`);

  // Again: the best run is a ghost now.
  await lab.button('From the start').click();
  await until('the start', () => lab.state.tick === 0);
  await expect(page.getByRole('table', { name: 'Scores on this challenge' })).toContainText('Ada');
  await lab.button('Start').click();
  await until('the clock', () => lab.state.tick > 100);
  // Start moves the focus to the map: arrows steer, and stray keys do not end the attempt.
  for (const key of ['Space', 'r', 'd', 'Enter', ']']) await page.keyboard.press(key);
  await page.keyboard.down('ArrowLeft');
  await until('the hand', () => lab.state.steer_m);
  await page.keyboard.up('ArrowLeft');
  expect(lab.state.attempt?.void).toBeNull();
  await lab.button('Pause').click();
  await expect(page.getByRole('region', { name: 'Challenge', exact: true })).toContainText(
    'does not count: it was paused',
  );
});

test('a viewer gets a session of its own for the challenge of a link', async ({
  session,
  lab,
  openLab,
}) => {
  await lab.isRole('operator');
  const viewer = await openLab({ url: `${session.url}?challenge=${NAME}` });
  const { page } = viewer;
  await viewer.isRole('viewer');
  expect(viewer.scene.challenge, 'a viewer changes nothing').toBeNull();
  await page.getByRole('button', { name: 'Play in a session of your own' }).click();
  await viewer.isRole('operator');
  await until('the challenge', () => viewer.scene.challenge === NAME);
  const own = new URL(`/api/sessions/${viewer.hello.session}`, page.url());
  expect((await page.request.delete(own.href)).ok()).toBe(true);
});
