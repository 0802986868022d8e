// A hand that holds the bead and does not move: its page says that it is there. Without that it releases.

import { type Lab, expect, test } from './fixtures';
import { inSpace } from './support/moments';
import { until } from './support/wait';

/** The server releases a hand that it has received nothing of for five seconds. */
const LONGER_MS = 6500;
const LONGER_TICKS = LONGER_MS / 8;
/** The page reports a still hand each second. */
const REPORT_TICKS = 1200 / 8;
const SILENT = /no message from the page that holds the bead/i;

async function takeByMouse(lab: Lab) {
  await lab.pull(lab.freePoints(await lab.bead(), 0.05, 0.1)[0]);
  await lab.page.keyboard.press(' ');
  await until('running', () => lab.state.running);
}

async function takeByKeyboard(lab: Lab) {
  await lab.run();
  await lab.canvas.focus();
  await lab.page.keyboard.press('d');
  await until('the hand', () => lab.state.hand_m);
}

async function takeInSpace(lab: Lab) {
  await inSpace(lab);
  await lab.run();
  await lab.label('Scene').focus();
  await lab.page.keyboard.press('d');
  await until('the hand', () => lab.state.hand_m);
}

const HOLDS = {
  'the mouse': { take: takeByMouse, end: (lab: Lab) => lab.page.mouse.up() },
  'the keyboard': {
    take: takeByKeyboard,
    end: (lab: Lab) => lab.page.keyboard.press('Escape'),
  },
  'the keyboard in the 3-D view': {
    take: takeInSpace,
    end: (lab: Lab) => lab.page.keyboard.press('Escape'),
  },
};

for (const [how, { take, end }] of Object.entries(HOLDS)) {
  test(`holds the bead with a still hand by ${how}`, async ({ lab }) => {
    await lab.reset();
    await take(lab);
    // At speed 1 a tick is 8 ms.
    await lab.later(LONGER_TICKS);
    expect(lab.state.hand_m, 'the hand').not.toBeNull();
    await end(lab);
    await until('no hand', () => !lab.state.hand_m);
    lab.sent = {};
    await lab.later(REPORT_TICKS);
    expect(lab.sent.drag, 'a report of a hand that has released').toBeUndefined();
  });
}

test('releases the bead while its page sleeps', async ({ lab }) => {
  await lab.reset();
  await takeByMouse(lab);
  // The page's thread does something else.
  await lab.page.evaluate((ms) => {
    const end = performance.now() + ms;
    while (performance.now() < end);
  }, LONGER_MS);
  await lab.notice('workspace').getByText(SILENT).waitFor();
  await until('no hand', () => !lab.state.hand_m);
  await until('paused', () => !lab.state.running);
  // Awake again, it does not take by moving what it had been holding.
  lab.sent = {};
  const [x, y] = await lab.px(await lab.bead());
  await lab.page.mouse.move(x + 40, y + 20, { steps: 4 });
  await lab.page.keyboard.press(' ');
  await lab.later(REPORT_TICKS);
  expect(lab.state.hand_m, 'the page took the bead again by itself').toBeNull();
  expect(lab.sent.drag).toBeUndefined();
  await lab.page.mouse.up();
});

test('releases the bead when the trial restarts', async ({ lab }) => {
  await takeByKeyboard(lab);
  await lab.later(50);
  lab.sent = {};
  await lab.button('Reset').evaluate((button: HTMLElement) => {
    button.click();
  });
  await until('the start', () => lab.state.tick === 0 && !lab.state.hand_m);
  await lab.run();
  await lab.later(REPORT_TICKS);
  expect(lab.state.hand_m, 'the hand took the bead again in another trial').toBeNull();
});
