// The hand that holds the bead and does not move: it says that it is there, and who says nothing has gone.

import { check, until } from './harness.mjs';
import { inSpace } from './moments.mjs';

/** The server lets go of what it heard nothing of for five seconds. */
const LONGER_MS = 6500;

/** Presses the mouse on the bead and drags it a little. */
async function takeByMouse(lab) {
  const bead = await lab.point('bead');
  const { mouse } = lab.page;
  await mouse.move(...(await lab.px(bead)));
  await mouse.down();
  await mouse.move(...(await lab.px(lab.freePoints(bead, 0.05, 0.1)[0])), { steps: 4 });
  await until('the hand', () => lab.state.hand_m);
  await lab.page.keyboard.press(' ');
  await until('running', () => lab.state.running);
}

async function takeByKeyboard(lab) {
  await lab.run();
  await until('running', () => lab.state.running);
  await lab.canvas.focus();
  await lab.page.keyboard.press('d');
  await until('the hand', () => lab.state.hand_m);
}

const view = (lab, name) => lab.page.getByRole('radio', { name, exact: true });

async function takeInSpace(lab) {
  await view(lab, '3-D').check();
  await inSpace(lab);
  await lab.run();
  await until('running', () => lab.state.running);
  await lab.page.getByLabel('Scene', { exact: true }).focus();
  await lab.page.keyboard.press('d');
  await until('the hand', () => lab.state.hand_m);
}

async function holdsStill({ lab }) {
  for (const [how, take, end] of [
    ['mouse', takeByMouse, () => lab.page.mouse.up()],
    ['keyboard', takeByKeyboard, () => lab.page.keyboard.press('Escape')],
    ['keyboard in space', takeInSpace, () => lab.page.keyboard.press('Escape')],
  ]) {
    await lab.reset();
    await take(lab);
    const { tick } = lab.state;
    await lab.page.waitForTimeout(LONGER_MS);
    check(lab.state.hand_m, `the ${how} holds still, and the bead was taken from it`);
    check(lab.state.running && lab.state.tick > tick, `time stands under the still ${how}`);
    await end();
    await until(`let go by ${how}`, () => !lab.state.hand_m);
    lab.sent.drag = undefined;
    await lab.page.waitForTimeout(1200);
    check(!lab.sent.drag, `the ${how} has let go, and says that it holds`);
    await lab.pause();
  }
  await view(lab, 'Plan').check();
}

/** A page whose thread does something else has no hand. */
async function losesWhatItSleepsOver({ lab }) {
  await lab.reset();
  await takeByMouse(lab);
  await lab.page.evaluate((ms) => {
    const end = performance.now() + ms;
    while (performance.now() < end);
  }, LONGER_MS);
  await lab.notice('workspace').getByText('nothing was heard from the hand').waitFor();
  await until('no hand', () => !lab.state.hand_m);
  await until('paused', () => !lab.state.running);
  // Awake again, it does not take by moving what it had been holding.
  const [x, y] = await lab.px(await lab.point('bead'));
  await lab.page.mouse.move(x + 40, y + 20, { steps: 4 });
  await lab.page.waitForTimeout(1200);
  check(!lab.state.hand_m, 'the page took the bead again by itself');
  await lab.page.mouse.up();
}

/** A hold is one of this moment: going back, or beginning anew, ends it. */
async function endsWithItsMoment({ lab }) {
  await lab.reset();
  await takeByKeyboard(lab);
  await until('some time', () => lab.state.tick > 50);
  await lab.button('Reset').evaluate((button) => button.click());
  await until('the start', () => lab.state.tick === 0 && !lab.state.hand_m);
  await lab.page.waitForTimeout(1200);
  check(!lab.state.hand_m, 'the hand took the bead again in another trial');
}

export const HOLDS = [
  ['holds the bead with a still hand', holdsStill],
  ['loses the bead while its page sleeps', losesWhatItSleepsOver],
  ['ends a hold with its moment', endsWithItsMoment],
];
