// Holding the bead without moving it: the page reports the hand to the server each second.
// Without these reports the server releases the bead.

import { LONG, type Lab, expect, test } from './fixtures';
import { openSceneView } from './support/preconditions';
import { until } from './support/wait';

/** The server releases a hand at the latest six seconds after its last report. */
const SILENCE_MS = 9000;
/** Longer than the five seconds after which it may release a hand. */
const LONGER_TICKS = 5600 / 8;
/** Longer than the second between two reports. */
const REPORT_TICKS = 1200 / 8;
const SILENT = /received nothing from the hand for a time: it released the bead and paused/;

async function takeByMouse(lab: Lab) {
  await lab.startDrag(lab.freePoints(await lab.bead(), 0.05, 0.1)[0]);
  await lab.page.keyboard.press(' ');
  await until('running', () => lab.state.running);
}

async function takeByKeyboard(lab: Lab) {
  await lab.run();
  await lab.canvas.focus();
  await lab.page.keyboard.press('d');
  await until('the hand', () => lab.state.hand_m);
}

async function takeIn3dView(lab: Lab) {
  await openSceneView(lab);
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
    take: takeIn3dView,
    end: (lab: Lab) => lab.page.keyboard.press('Escape'),
  },
};

for (const [how, { take, end }] of Object.entries(HOLDS)) {
  test(`holds the bead by ${how} without moving it`, LONG, async ({ lab }) => {
    await lab.reset();
    await take(lab);
    // At speed 1 a tick is 8 ms.
    await lab.later(LONGER_TICKS);
    expect(lab.state.hand_m, 'the hand is kept').not.toBeNull();
    await end(lab);
    await until('no hand', () => !lab.state.hand_m);
    lab.sent = {};
    await lab.later(REPORT_TICKS);
    expect(lab.sent.drag, 'a report after the release').toBeUndefined();
  });
}

test('releases the bead when the page does not respond', LONG, async ({ lab }) => {
  await lab.reset();
  await takeByMouse(lab);
  // Blocks the page's thread.
  await lab.page.evaluate((ms) => {
    const end = performance.now() + ms;
    while (performance.now() < end);
  }, SILENCE_MS);
  await lab.notice('workspace').getByText(SILENT).waitFor();
  await until('no hand', () => !lab.state.hand_m);
  await until('paused', () => !lab.state.running);
  // When the page responds again, a pointer movement does not take the bead again.
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
