// The hand on the bead: mouse and touch, and everything that makes it release.

import { TABLET } from './support/browser';
import { type Lab, expect, test } from './fixtures';
import { type PointLike, distance, flat } from './support/table';
import { must, until } from './support/wait';

const beside = async (lab: Lab) => lab.freePoints(await lab.bead(), 0.05, 0.1)[0];
const released = (lab: Lab) => until('no hand', () => !lab.state.hand_m);

/** Presses the mouse on the bead, once it rests, and drags it to a place beside it. */
async function take(lab: Lab) {
  let before: PointLike | undefined;
  await until('a bead at rest', () => {
    const rests = before && distance(before, lab.state.bead_m) < 1e-4;
    before = lab.state.bead_m;
    return rests;
  });
  const away = await beside(lab);
  await lab.pull(away);
  return away;
}

test('shows that the bead can be taken', async ({ lab }) => {
  const { mouse } = lab.page;
  const [x, y] = await lab.px(await lab.bead());
  await mouse.move(x + 60, y - 40);
  await expect(lab.canvas).toHaveCSS('cursor', 'crosshair');
  // The ring is 16 px around the bead; just inside its edge lies its tint.
  const tint = async () => {
    const clip = { x: Math.round(x) + 10, y: Math.round(y) - 8, width: 3, height: 3 };
    return (await lab.page.screenshot({ clip })).toString('base64');
  };
  const bare = await tint();
  await mouse.move(x + 2, y + 2);
  await expect(lab.canvas).toHaveCSS('cursor', 'grab');
  await until('the ring', async () => (await tint()) !== bare);

  // Two pixels are still a click, which places a goal; more is a pull.
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
  expect(lab.state.goal_m, 'a pull placed a goal').toBeNull();
});

test('places the bead while paused', async ({ lab }) => {
  await lab.reset();
  const to = await take(lab);
  expect(distance(await lab.bead(), to), 'it moves only when released').toBeGreaterThan(0.03);
  await lab.page.mouse.up();
  await until('the bead there', async () => distance(await lab.bead(), to) < 0.01);
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
    // As with the keyboard: the mouse is busy.
    await lab.button('Recordings').evaluate((button: HTMLElement) => {
      button.click();
    });
  },
};

for (const [when, happen] of Object.entries(ENDS)) {
  test(`releases the bead when ${when}`, async ({ lab }) => {
    await lab.run();
    await take(lab);
    await happen(lab);
    await released(lab);
    await lab.page.mouse.up();
    await lab.view('Laboratory').click();
    await lab.pause();
    // What was drawn of the hand is removed, and one press is still one goal.
    let sockets = 0;
    lab.page.on('websocket', () => (sockets += 1));
    await lab.setGoal(await beside(lab));
    expect(sockets, 'coming back opened another WebSocket').toBe(0);
  });
}

test('releases the bead when the socket closes', async ({ lab, openLab }) => {
  await lab.releaseControl();
  // Control that is free goes to the next who comes.
  const other = await openLab();
  await other.isRole('operator');
  await other.reset();
  await take(other);
  await until('the hand, seen from here', () => lab.state.hand_m);
  // The page closes with the bead in the hand.
  await other.page.close();
  await released(lab);
  await lab.takeControl();
});

test.describe('on a tablet', () => {
  test.use({ ...TABLET, isMobile: true });

  test('follows a finger', async ({ lab }) => {
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
    const scrolled = () => page.evaluate(() => window.scrollY);
    const bead = await lab.bead();
    const [x, y] = await lab.px(bead);

    // A tap is a goal.
    const [goal] = lab.freePoints(bead, 0.1, 0.2);
    await page.touchscreen.tap(...(await lab.px(goal)));
    await until('a goal under the finger', () => {
      const set = lab.state.goal_m;
      return set && distance(set, goal) < 0.005;
    });

    // A finger beside the bead still takes it, and the page stays where it is.
    await touch('touchStart', [x + 12, y - 12]);
    for (let i = 1; i <= 8; i++) await touch('touchMove', [x + 12, y - 12 - 10 * i]);
    await until('the hand', () => lab.state.hand_m);
    expect(await scrolled(), 'the page scrolled under the bead').toBe(0);
    await touch('touchEnd');
    await released(lab);

    // Where the browser takes the finger for itself, to zoom with a second one, the hand releases.
    const [bx, by] = await lab.px(await lab.bead());
    await touch('touchStart', [bx, by]);
    await touch('touchMove', [bx, by - 30]);
    await until('the hand again', () => lab.state.hand_m);
    await touch('touchCancel');
    await released(lab);

    // Elsewhere a finger scrolls.
    const heading = page.getByRole('heading', { name: 'Workspace' });
    const head = must(await heading.boundingBox(), 'a heading');
    await touch('touchStart', [head.x + 20, head.y + 8]);
    for (let i = 1; i <= 6; i++) await touch('touchMove', [head.x + 20, head.y + 8 - 12 * i]);
    await touch('touchEnd');
    await expect.poll(scrolled, { message: 'a scrolled page' }).toBeGreaterThan(20);

    // Two fingers on the plan zoom, and neither place a goal nor take the bead.
    const before = flat(must(lab.state.goal_m, 'a goal'));
    const box = must(await lab.canvas.boundingBox(), 'the canvas');
    const fingers = (half: number): PointLike[] =>
      [-half, half].map((dx) => [box.x + box.width / 2 + dx, box.y + box.height / 2]);
    await touch('touchStart', ...fingers(40));
    for (let i = 1; i <= 8; i++) await touch('touchMove', ...fingers(40 + 10 * i));
    await touch('touchEnd');
    await expect
      .poll(() => page.evaluate(() => window.visualViewport?.scale), { message: 'a larger page' })
      .toBeGreaterThan(1.5);
    expect(lab.state.hand_m, 'two fingers took the bead').toBeNull();
    expect(flat(must(lab.state.goal_m, 'a goal'))).toEqual(before);
  });
});
