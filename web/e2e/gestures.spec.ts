// Drags the bead in the plan view by mouse and by touch, and tests every event that releases it.
// The test that drags the bead by keyboard is in laboratory.spec.ts.

import { TABLET } from './support/browser';
import { type Lab, expect, test } from './fixtures';
import { type PointLike, distance, flat } from './support/table';
import { must, until } from './support/wait';

const beside = async (lab: Lab) => lab.freePoints(await lab.bead(), 0.05, 0.1)[0];
const released = (lab: Lab) => until('no hand', () => !lab.state.hand_m);

/** Waits until the bead rests and drags it by mouse to a place beside it, without releasing it. */
async function takeBead(lab: Lab) {
  let before: PointLike | undefined;
  await until('a bead at rest', () => {
    const isAtRest = before && distance(before, lab.state.bead_m) < 1e-4;
    before = lab.state.bead_m;
    return isAtRest;
  });
  const away = await beside(lab);
  await lab.startDrag(away);
  return away;
}

test('marks the bead under the pointer, and distinguishes a click from a drag', async ({ lab }) => {
  const { mouse } = lab.page;
  const [x, y] = await lab.px(await lab.bead());
  await mouse.move(x + 60, y - 40);
  await expect(lab.canvas).toHaveCSS('cursor', 'crosshair');
  // The ring has a radius of 21 px around the bead: dashes, and a whole line under the pointer.
  const tint = async () => {
    const clip = { x: Math.round(x) + 11, y: Math.round(y) - 19, width: 8, height: 8 };
    return (await lab.page.screenshot({ clip })).toString('base64');
  };
  const bare = await tint();
  await mouse.move(x + 2, y + 2);
  await expect(lab.canvas).toHaveCSS('cursor', 'grab');
  await until('the ring', async () => (await tint()) !== bare);

  // A movement by two pixels is still a click, which places a goal. More is a drag.
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + 2, y + 2);
  await mouse.up();
  await until('a goal', () => lab.state.goal_m);
  expect(lab.state.hand_m, 'a click took the bead').toBeNull();
  await lab.button('Clear goal').click();
  await until('no goal', () => !lab.state.goal_m);
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + 6, y, { steps: 3 });
  await until('the hand', () => lab.state.hand_m);
  await expect(lab.canvas).toHaveCSS('cursor', 'grabbing');
  await mouse.up();
  await released(lab);
  expect(lab.state.goal_m, 'a drag placed a goal').toBeNull();
});

test('places the bead on release while paused', async ({ lab }) => {
  await lab.reset();
  const to = await takeBead(lab);
  expect(distance(await lab.bead(), to), 'distance before the release').toBeGreaterThan(0.03);
  await lab.page.mouse.up();
  await until('the bead at its new place', async () => distance(await lab.bead(), to) < 0.01);
});

const ENDS: Record<string, (lab: Lab) => Promise<unknown>> = {
  'the window loses the focus': ({ page }) =>
    page.evaluate(() => window.dispatchEvent(new Event('blur'))),
  'the tab is hidden': ({ page }) =>
    page.evaluate(() => {
      Object.defineProperty(document, 'hidden', { configurable: true, value: true });
      document.dispatchEvent(new Event('visibilitychange'));
      Reflect.deleteProperty(document, 'hidden');
    }),
  'another view opens': async (lab) => {
    await lab.page.keyboard.press('Escape');
    // By script, because the mouse button is pressed.
    await lab.view('Recordings').evaluate((button: HTMLElement) => {
      button.click();
    });
  },
};

for (const [when, cause] of Object.entries(ENDS)) {
  test(`releases the bead when ${when}`, async ({ lab }) => {
    await lab.run();
    await takeBead(lab);
    await cause(lab);
    await released(lab);
    await lab.page.mouse.up();
    await lab.view('Lab').click();
    await lab.pause();
    // The page draws no hand any more, and a click sets one goal.
    let sockets = 0;
    lab.page.on('websocket', () => (sockets += 1));
    await lab.setGoal(await beside(lab));
    expect(sockets, 'the page opened another WebSocket').toBe(0);
  });
}

test('releases the bead when the connection closes', async ({ lab, openLab }) => {
  await lab.releaseControl();
  // Free control goes to the next browser that connects.
  const other = await openLab();
  await other.isRole('operator');
  await other.reset();
  await takeBead(other);
  await until("the hand on the viewer's page", () => lab.state.hand_m);
  await other.page.close();
  await released(lab);
  await lab.takeControl();
});

test.describe('on a tablet', () => {
  test.use({ ...TABLET, isMobile: true });

  test('drags the bead with one finger, and scrolls and zooms elsewhere', async ({ lab }) => {
    const { page } = lab;
    const cdp = await page.context().newCDPSession(page);
    const touch = (
      type: 'touchStart' | 'touchMove' | 'touchEnd' | 'touchCancel',
      ...points: PointLike[]
    ) =>
      cdp.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: points.map(([x, y], id) => ({ x, y, id })),
      });
    await lab.panel('Tune');
    const panel = page.getByRole('tabpanel');
    const scrolled = async () =>
      (await page.evaluate(() => window.scrollY)) + (await panel.evaluate((at) => at.scrollTop));
    const bead = await lab.bead();
    const [x, y] = await lab.px(bead);

    // A tap places a goal.
    const [goal] = lab.freePoints(bead, 0.1, 0.2);
    await page.touchscreen.tap(...(await lab.px(goal)));
    await until('a goal under the finger', () => {
      const set = lab.state.goal_m;
      return set && distance(set, goal) < 0.005;
    });

    // A finger beside the bead still takes it, and the page does not scroll.
    await touch('touchStart', [x + 12, y - 12]);
    for (let i = 1; i <= 8; i++) await touch('touchMove', [x + 12, y - 12 - 10 * i]);
    await until('the hand', () => lab.state.hand_m);
    expect(await scrolled(), 'the page scrolled under the bead').toBe(0);
    await touch('touchEnd');
    await released(lab);

    // The hand releases when the browser cancels the touch, as it does for a zoom.
    const [bx, by] = await lab.px(await lab.bead());
    await touch('touchStart', [bx, by]);
    await touch('touchMove', [bx, by - 30]);
    await until('the hand again', () => lab.state.hand_m);
    await touch('touchCancel');
    await released(lab);

    // Elsewhere a finger scrolls.
    const heading = panel.getByRole('heading', { name: 'Tune' });
    const head = must(await heading.boundingBox(), 'a heading');
    await touch('touchStart', [head.x + 20, head.y + 8]);
    for (let i = 1; i <= 6; i++) await touch('touchMove', [head.x + 20, head.y + 8 - 12 * i]);
    await touch('touchEnd');
    await expect.poll(scrolled, { message: 'a scrolled panel' }).toBeGreaterThan(20);

    // Two fingers on the plan zoom it. They neither place a goal nor take the bead.
    const scale = async () => Number(await lab.canvas.getAttribute('data-px-per-m'));
    const whole = await scale();
    const before = flat(must(lab.state.goal_m, 'a goal'));
    const box = must(await lab.canvas.boundingBox(), 'the canvas');
    const fingers = (half: number): PointLike[] =>
      [-half, half].map((dx) => [box.x + box.width / 2 + dx, box.y + box.height / 2]);
    await touch('touchStart', ...fingers(40));
    for (let i = 1; i <= 8; i++) await touch('touchMove', ...fingers(40 + 10 * i));
    await touch('touchEnd');
    await expect.poll(scale, { message: 'a zoomed plan' }).toBeGreaterThan(1.5 * whole);
    expect(await page.evaluate(() => window.visualViewport?.scale), 'the page zoomed').toBe(1);
    expect(lab.state.hand_m, 'two fingers took the bead').toBeNull();
    expect(flat(must(lab.state.goal_m, 'a goal'))).toEqual(before);

    // A third finger does neither, and no finger is left over: the next tap places a goal.
    lab.sent = {};
    await touch('touchStart', ...fingers(40));
    await touch('touchStart', ...fingers(40), [box.x + box.width / 2, box.y + box.height / 4]);
    await touch('touchEnd');
    await lab.canvas.press('Home');
    await expect.poll(scale).toBe(whole);
    expect(lab.sent.set_goal, 'a third finger placed a goal').toBeUndefined();
    const [other] = lab.freePoints(goal, 0.1, 0.2);
    await page.touchscreen.tap(...(await lab.px(other)));
    await until('the other goal', () => {
      const set = lab.state.goal_m;
      return set && distance(set, other) < 0.005;
    });

    // While the page itself is zoomed, two fingers on the plan zoom the page, so that the user gets out.
    await expect(lab.canvas).toHaveCSS('touch-action', 'none');
    await cdp.send('Emulation.setPageScaleFactor', { pageScaleFactor: 2 });
    await expect(lab.canvas).toHaveCSS('touch-action', 'pinch-zoom');
    await cdp.send('Emulation.setPageScaleFactor', { pageScaleFactor: 1 });
    await expect(lab.canvas).toHaveCSS('touch-action', 'none');
  });
});
