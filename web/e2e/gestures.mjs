// The hand on the bead: mouse and touch, and everything that makes it let go.

import { check, until } from './harness.mjs';
import { Lab, distance } from './lab.mjs';

/** Presses the mouse on the bead, once it rests, and drags it to a place beside it. */
async function take(lab) {
  const { mouse } = lab.page;
  let before;
  await until('a bead at rest', () => {
    const rests = before && distance(before, lab.state.bead_m) < 1e-4;
    before = lab.state.bead_m;
    return rests;
  });
  const away = await beside(lab);
  await mouse.move(...(await lab.px(await lab.point('bead'))));
  await mouse.down();
  await mouse.move(...(await lab.px(away)), { steps: 6 });
  await until('the hand', () => lab.state.hand_m);
  return away;
}

async function beside(lab, least_m = 0.05, most_m = 0.1) {
  return lab.freePoints(await lab.point('bead'), least_m, most_m)[0];
}

export async function showsThatTheBeadCanBeTaken({ lab }) {
  await lab.reset();
  const { mouse } = lab.page;
  const bead = await lab.point('bead');
  const [x, y] = await lab.px(bead);
  const cursor = () => lab.canvas.evaluate((canvas) => getComputedStyle(canvas).cursor);
  await mouse.move(x + 60, y - 40);
  check((await cursor()) === 'crosshair', `far from the bead the cursor is ${await cursor()}`);
  // The ring is 16 px around the bead; just inside of its edge lies its tint.
  const tint = async () => {
    const clip = { x: Math.round(x) + 10, y: Math.round(y) - 8, width: 3, height: 3 };
    return (await lab.page.screenshot({ clip })).toString('base64');
  };
  const bare = await tint();
  await mouse.move(x + 2, y + 2);
  await until('the open hand', async () => (await cursor()) === 'grab');
  await until('the ring', async () => (await tint()) !== bare);

  // Three pixels are still a click, which places a goal; more is a pull.
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + 2, y + 2);
  await mouse.up();
  await until('a goal', () => lab.state.goal_m);
  check(!lab.state.hand_m, 'a click took the bead');
  await lab.button('Clear goal').click();
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + 6, y, { steps: 3 });
  await until('the hand', () => lab.state.hand_m);
  check((await cursor()) === 'grabbing', `while held the cursor is ${await cursor()}`);
  await mouse.up();
  await until('let go', () => !lab.state.hand_m);
  check(!lab.state.goal_m, 'a pull placed a goal');
}

export async function placesTheBeadWhilePaused({ lab }) {
  await lab.reset();
  const to = await take(lab);
  check(distance(await lab.point('bead'), to) > 0.03, 'the bead moved while time stood');
  await lab.screenshot('spring');
  await lab.page.mouse.up();
  await until('the bead put there', async () => distance(await lab.point('bead'), to) < 0.01);
}

export async function letsGoByItself({ lab }) {
  const { page } = lab;
  await lab.reset();
  await lab.run();
  for (const [what, happen] of [
    ['blur', () => page.evaluate(() => window.dispatchEvent(new Event('blur')))],
    [
      'a hidden tab',
      () =>
        page.evaluate(() => {
          Object.defineProperty(document, 'hidden', { configurable: true, value: true });
          document.dispatchEvent(new Event('visibilitychange'));
          delete document.hidden;
        }),
    ],
    ['another view', () => page.keyboard.press('Escape')],
  ]) {
    await take(lab);
    if (what === 'another view') {
      // As with the keyboard: the mouse is busy.
      await lab.button('Recordings').evaluate((button) => button.click());
    } else {
      await happen();
    }
    await until(`let go after ${what}`, () => !lab.state.hand_m);
    await page.mouse.up();
    if (what === 'another view') await lab.button('Laboratory').click();
  }
  await lab.pause();
  // What was drawn of the hand is gone with it, and the page hears of one press once.
  await lab.reset();
  const sent = [];
  page.once('websocket', () => sent.push('another socket'));
  await lab.click(await beside(lab));
  await until('a goal', () => lab.state.goal_m);
  check(sent.length === 0, 'coming back opened another socket');
  await lab.button('Clear goal').click();
}

export async function letsGoWhenTheSocketIsLost({ lab, browser, server }) {
  await lab.button('Release control').click();
  await until('a viewer', async () => (await lab.text('role')) === 'viewer');
  // Whoever comes while nobody has control gets it.
  const other = await Lab.open(browser, server.url);
  await until('the operator', async () => (await other.text('role')) === 'operator');
  await other.reset();
  await take(other);
  await until('the hand, seen from here', () => lab.state.hand_m);
  // The page goes away with the bead in the hand.
  await other.page.close();
  await until('let go', () => !lab.state.hand_m);
  await lab.button('Take control').click();
  await until('the operator again', async () => (await lab.text('role')) === 'operator');
}

export async function followsAFinger({ lab, browser, server }) {
  await lab.reset();
  await lab.button('Release control').click();
  await until('a viewer', async () => (await lab.text('role')) === 'viewer');
  const context = await browser.newContext({
    viewport: { width: 820, height: 1180 },
    hasTouch: true,
    isMobile: true,
    colorScheme: 'dark',
  });
  const tablet = await Lab.open(context, server.url);
  try {
    await until('the operator', async () => (await tablet.text('role')) === 'operator');
    const { page } = tablet;
    const session = await context.newCDPSession(page);
    const touch = (type, ...points) =>
      session.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: points.map(([x, y], id) => ({ x, y, id })),
      });
    const scrolled = () => page.evaluate(() => window.scrollY);
    const bead = await tablet.point('bead');
    const [x, y] = await tablet.px(bead);

    // A tap is a goal.
    const [goal] = tablet.freePoints(bead, 0.1, 0.2);
    await page.touchscreen.tap(...(await tablet.px(goal)));
    const isThere = () => tablet.state.goal_m && distance(tablet.state.goal_m, goal) < 0.005;
    await until('a goal under the finger', isThere);

    // A finger beside the bead still takes it, and the page stays where it is.
    await touch('touchStart', [x + 12, y - 12]);
    for (let i = 1; i <= 8; i++) await touch('touchMove', [x + 12, y - 12 - 10 * i]);
    await until('the hand', () => tablet.state.hand_m);
    check((await scrolled()) === 0, 'the page scrolled under the bead');
    await touch('touchEnd');
    await until('let go', () => !tablet.state.hand_m);

    // Where the browser takes the finger for itself, to zoom with a second one, the hand lets go.
    const [bx, by] = await tablet.px(await tablet.point('bead'));
    await touch('touchStart', [bx, by]);
    await touch('touchMove', [bx, by - 30]);
    await until('the hand again', () => tablet.state.hand_m);
    await touch('touchCancel');
    await until('let go when cancelled', () => !tablet.state.hand_m);
    // Elsewhere a finger scrolls.
    const head = await page.getByRole('heading', { name: 'Workspace' }).boundingBox();
    await touch('touchStart', [head.x + 20, head.y + 8]);
    for (let i = 1; i <= 6; i++) await touch('touchMove', [head.x + 20, head.y + 8 - 12 * i]);
    await touch('touchEnd');
    await until('a scrolled page', async () => (await scrolled()) > 20);

    // Two fingers on the plan zoom, and neither place a goal nor take the bead.
    const before = tablet.state.goal_m;
    const { x: left, y: top, width, height: high } = await tablet.canvas.boundingBox();
    const pair = (half) => [-half, half].map((dx) => [left + width / 2 + dx, top + high / 2]);
    await touch('touchStart', ...pair(40));
    for (let i = 1; i <= 8; i++) await touch('touchMove', ...pair(40 + 10 * i));
    await touch('touchEnd');
    await until('a larger page', () => page.evaluate(() => window.visualViewport.scale > 1.5));
    check(!tablet.state.hand_m, 'two fingers took the bead');
    check(distance(tablet.state.goal_m, before) === 0, 'two fingers placed a goal');
  } finally {
    await context.close();
    await lab.button('Take control').click();
  }
  await until('the operator again', async () => (await lab.text('role')) === 'operator');
}
