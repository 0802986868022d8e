// The 3-D view supports every action of the plan view, by mouse and by keyboard.
// Also: its viewpoints, its graphics memory, and browsers without WebGL 2.

import { type Lab, expect, test } from './fixtures';
import { CONTROL_STEP_TICKS } from './support/stepper';
import { openSceneView } from './support/preconditions';
import {
  beadPx,
  freeInPicture,
  gpuObjects,
  projection,
  px,
  sceneOf,
  settled,
} from './support/scene';
import { distance } from './support/table';
import { must, until } from './support/wait';

const NO_WEBGL = /it has no WebGL 2/i;

const differ = (a: readonly number[], b: readonly number[]) =>
  Math.max(...a.map((n, i) => Math.abs(n - (b[i] ?? NaN))));

const picture = (lab: Lab) => sceneOf(lab).screenshot();

test('places a goal in the 3-D view', async ({ lab }) => {
  await openSceneView(lab);
  await expect(lab.canvas).toBeHidden();
  const goal = await freeInPicture(lab, 0.1, 0.25);
  await lab.page.mouse.click(...(await px(lab, goal)));
  const set = await until('a goal', () => lab.state.goal_m);
  expect(distance(set, goal)).toBeLessThan(0.002);
  await lab.stepUntil(
    'a carried bead',
    () => lab.state.phase.code === 'transporting',
    CONTROL_STEP_TICKS,
  );
});

test('drags the bead by mouse in the 3-D view', async ({ lab }) => {
  await openSceneView(lab);
  const { mouse } = lab.page;
  await settled(lab);
  const camera = await projection(lab);
  const away = await freeInPicture(lab, 0.06, 0.12);
  const bead = lab.state.bead_m;
  await mouse.move(...(await beadPx(lab)));
  await expect(sceneOf(lab)).toHaveAttribute('data-cursor', 'near-bead');
  await mouse.down();
  await mouse.move(...(await px(lab, away)), { steps: 10 });
  await until(
    'the hand at the pointer',
    () => lab.state.hand_m && distance(lab.state.hand_m, away) < 0.003,
  );
  await lab.stepUntil('the bead at the hand', () => distance(lab.state.bead_m, away) < 0.01, 25);
  expect(distance(lab.state.bead_m, bead)).toBeGreaterThan(0.03);
  await expect(lab.page.locator('.spring-label')).toHaveText(/\d N · |mN · /);
  await mouse.up();
  await until('no hand', () => !lab.state.hand_m);
  expect(await projection(lab), 'dragging the bead turned the view').toEqual(camera);
  expect(lab.state.goal_m, 'dragging the bead placed a goal').toBeNull();
});

test('turns and zooms the 3-D view, and returns to its viewpoints', async ({ lab }) => {
  await openSceneView(lab);
  await settled(lab);
  const { mouse, keyboard } = lab.page;
  const canvas = sceneOf(lab);
  const home = await projection(lab);
  const before = await picture(lab);
  const box = await lab.boxOf(canvas);
  const corner = [box.x + 40, box.y + box.height - 30] as const;
  await mouse.move(...corner);
  await mouse.down();
  await mouse.move(corner[0] + 120, corner[1] - 30, { steps: 6 });
  await mouse.up();
  const turned = await projection(lab);
  expect(differ(turned, home), 'the view did not turn').toBeGreaterThan(10);
  await until('another picture', async () => !(await picture(lab)).equals(before));
  expect(lab.state.goal_m, 'turning the view placed a goal').toBeNull();
  await mouse.wheel(0, -240);
  await until('a nearer view', async () => differ(await projection(lab), turned) > 10);
  for (const name of ['Top', 'Front', 'Side']) {
    const last = await projection(lab);
    await lab.button(name).click();
    await until(name, async () => differ(await projection(lab), last) > 0);
  }
  await canvas.focus();
  await keyboard.press('Home');
  await until('home', async () => differ(await projection(lab), home) < 1e-3);
});

test('shows the layer Field and pull in the 3-D view', async ({ lab }) => {
  await openSceneView(lab);
  await settled(lab);
  const bare = await picture(lab);
  await lab.layer('Field and pull');
  await until('a picture with the layer', async () => !(await picture(lab)).equals(bare));
  await settled(lab);
  await lab.layer('Field and pull', false);
  await until('a picture without the layer', async () => (await picture(lab)).equals(bare));
});

test('places a goal, runs and drags the bead by keyboard in the 3-D view', async ({ lab }) => {
  await openSceneView(lab);
  await sceneOf(lab).focus();
  const { keyboard } = lab.page;
  await keyboard.press('Home');
  const bead = lab.state.bead_m;
  const [aim] = lab.freePoints(bead, 0.04, 0.12);
  for (const [delta, back, forth] of [
    [aim[0] - bead[0], 'ArrowLeft', 'ArrowRight'],
    [aim[1] - bead[1], 'ArrowDown', 'ArrowUp'],
  ] as const) {
    const presses = Math.max(1, Math.round(Math.abs(delta) / 0.005));
    for (let i = 0; i < presses; i++) await keyboard.press(delta < 0 ? back : forth);
  }
  await keyboard.press('Enter');
  const goal = await until('a goal', () => lab.state.goal_m);
  expect(distance(goal, aim)).toBeLessThan(0.01);
  await keyboard.press(' ');
  await until('running', () => lab.state.running);
  await keyboard.press('d');
  const held = await until('the hand', () => lab.state.hand_m);
  // The hand keeps its place on the table while the view turns.
  await keyboard.press(']');
  await keyboard.press('ArrowRight');
  const moved = await until('a hand that follows', () => {
    const hand = lab.state.hand_m;
    return hand && distance(hand, held) > 0 && hand;
  });
  expect(distance(moved, held), 'distance by which the hand moved').toBeLessThan(0.008);
  await keyboard.press('Escape');
  await until('no hand', () => !lab.state.hand_m);
});

test('frees the graphics memory of the 3-D view', async ({ lab }) => {
  // A reset may remove the hand and the trails a frame later. So only a growth is a leak.
  const grew = (now: readonly number[], before: readonly number[]) =>
    now.some((count, i) => count > (before[i] ?? 0));
  await openSceneView(lab);
  const first = await gpuObjects(lab);
  await lab.reset({ map: 'colon' });
  await settled(lab);
  await lab.button('Light').click();
  await settled(lab);
  await lab.button('Dark').click();
  await lab.reset();
  await until(`no more than ${first.join()}`, async () => !grew(await gpuObjects(lab), first));

  // A browser allows few contexts, and frees an unused one late unless the page releases it.
  const old = must(await sceneOf(lab).elementHandle(), 'the scene');
  await lab.radio('Plan').check();
  await until('a released context', () =>
    old.evaluate((canvas) => (canvas as HTMLCanvasElement).getContext('webgl2')?.isContextLost()),
  );
  await openSceneView(lab);
  await until(`${first.join()} again`, async () => !grew(await gpuObjects(lab), first));
});

test('remembers the 3-D view after a reload, and returns to the plan view', async ({ lab }) => {
  await openSceneView(lab);
  await lab.page.reload();
  await expect(sceneOf(lab)).toBeVisible();
  await lab.live();
  await lab.isRole('operator');
  await lab.radio('3-D').focus();
  await lab.page.keyboard.press('ArrowLeft');
  await lab.canvas.waitFor();
  await expect(sceneOf(lab)).toHaveCount(0);
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.2)[0]);
});

test('explains that the browser has no WebGL 2', async ({ lab }) => {
  // As in a browser without WebGL 2, or where it is switched off.
  await lab.page.evaluate(() => {
    const { prototype } = HTMLCanvasElement;
    // eslint-disable-next-line @typescript-eslint/unbound-method
    const { getContext } = prototype;
    prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
      return kind === 'webgl2' ? null : (getContext.call(this, kind, ...rest) as unknown);
    } as typeof getContext;
  });
  await lab.radio('3-D').check();
  await expect(lab.page.getByText(NO_WEBGL)).toBeVisible({ timeout: 30_000 });
  await lab.button('Back to the plan view').click();
  await lab.canvas.waitFor();
  await expect(lab.radio('Plan')).toBeChecked();
});
