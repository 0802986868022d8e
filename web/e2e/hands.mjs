// The ways to work a control: by mouse, by touch, by keyboard alone. Each hand can press, choose
// the next option, slide, type a number, place the goal and drag the bead.

import { until } from './harness.mjs';

/** Text fields take letters from the keyboard by whatever hand they were entered. */
async function type(page, text) {
  await page.keyboard.press('Control+a');
  await page.keyboard.type(text);
}

/** Where to take a slider: to the side with more room. */
async function slide(locator) {
  await locator.scrollIntoViewIfNeeded();
  const box = await locator.boundingBox();
  const share = await locator.evaluate((one) => (one.value - one.min) / (one.max - one.min));
  const y = box.y + box.height / 2;
  const px = (at) => [box.x + at * box.width, y];
  return [px(Math.min(0.95, Math.max(0.05, share))), px(share > 0.5 ? 0.25 : 0.75)];
}

/** The native list of a select is open: the next option, or the one before the last. */
async function chooseNext(page, locator) {
  const isLast = await locator.evaluate((one) => one.selectedIndex === one.options.length - 1);
  await page.keyboard.press(isLast ? 'ArrowUp' : 'ArrowDown');
}

/** The set that a radio or a tab is one of. */
export const setOf = (locator) =>
  locator.locator('xpath=ancestor::*[@role="tablist" or @role="radiogroup"][1]');

class Hand {
  constructor(lab) {
    this.lab = lab;
    this.page = lab.page;
  }

  /** A radio or a tab: another one has to be chosen before. */
  pick(locator) {
    return this.press(locator);
  }

  async choose(locator) {
    await this.press(locator);
    await chooseNext(this.page, locator);
    await this.page.keyboard.press('Enter');
  }
}

/** Mouse and touch: both drag. */
class Pointer extends Hand {
  async slide(locator) {
    const [from, to] = await slide(locator);
    await this.drag(from, to);
  }

  async dragBead() {
    const { lab } = this;
    const from = await lab.px(await lab.point('bead'));
    const to = await lab.px(lab.freePoints(await lab.point('bead'), 0.03, 0.08)[0]);
    await this.drag(from, to, () => until('the hand', () => lab.state.hand_m));
  }
}

export class Mouse extends Pointer {
  name = 'mouse';

  async press(locator) {
    await locator.click();
  }

  async drag(from, to, whileHeld = async () => {}) {
    const { mouse } = this.page;
    await mouse.move(...from);
    await mouse.down();
    await mouse.move(...to, { steps: 4 });
    await whileHeld();
    await mouse.up();
  }

  async type(locator, text) {
    await locator.click();
    await type(this.page, text);
    await this.page.keyboard.press('Tab');
  }

  async placeGoal(point) {
    await this.page.mouse.click(...(await this.lab.px(point)));
  }
}

export class Touch extends Pointer {
  name = 'touch';

  async press(locator) {
    await locator.tap();
  }

  async drag(from, to, whileHeld = async () => {}) {
    const cdp = await this.page.context().newCDPSession(this.page);
    const send = (event, points) =>
      cdp.send('Input.dispatchTouchEvent', {
        type: event,
        touchPoints: points.map(([x, y]) => ({ x, y })),
      });
    await send('touchStart', [from]);
    for (const share of [0.25, 0.5, 0.75, 1]) {
      const at = [0, 1].map((axis) => from[axis] + share * (to[axis] - from[axis]));
      await send('touchMove', [at]);
    }
    await whileHeld();
    // A finger that lifts while it moves flings, and the next tap would only stop that.
    await this.page.waitForTimeout(120);
    await send('touchEnd', []);
    await cdp.detach();
  }

  async type(locator, text) {
    await locator.tap();
    await type(this.page, text);
    await this.page.keyboard.press('Enter');
  }

  async placeGoal(point) {
    await this.page.touchscreen.tap(...(await this.lab.px(point)));
  }
}

/** What is disabled yet takes no focus, and the next key would go to what had it before. */
async function focus(locator) {
  await until('the focus', async () => {
    await locator.focus();
    return locator.evaluate((one) => one === document.activeElement);
  });
}

/** That Tab gets everywhere is looked at elsewhere; here the focus is set. */
export class Keys extends Hand {
  name = 'keyboard';

  async press(locator) {
    await focus(locator);
    const isBox = await locator.evaluate((one) => one.type === 'checkbox');
    await this.page.keyboard.press(isBox ? ' ' : 'Enter');
  }

  /** By arrows, from the one that is chosen now. */
  async pick(locator) {
    const role = await locator.evaluate((one) => one.getAttribute('role') ?? one.type);
    const chosen = (one) =>
      one.evaluate((it) => it.checked || it.getAttribute('aria-selected') === 'true');
    const all = await setOf(locator).getByRole(role).all();
    let isAny = false;
    for (const one of all) {
      if (!(await chosen(one))) continue;
      await focus(one);
      isAny = true;
    }
    if (!isAny) {
      await focus(locator);
      await this.page.keyboard.press(' ');
    }
    for (let pressed = 0; pressed < all.length && !(await chosen(locator)); pressed++) {
      await this.page.keyboard.press('ArrowRight');
    }
  }

  async choose(locator) {
    await focus(locator);
    await chooseNext(this.page, locator);
  }

  async slide(locator) {
    await focus(locator);
    const isHigh = await locator.evaluate((one) => one.value - one.min > (one.max - one.min) / 2);
    await this.page.keyboard.press(isHigh ? 'ArrowLeft' : 'ArrowRight');
  }

  /** One step by arrow where the field has steps, else by digits. */
  async type(locator, text) {
    await focus(locator);
    const { step, isUp } = await locator.evaluate((one, wish) => {
      return { step: one.step, isUp: Number(wish) > one.valueAsNumber };
    }, text);
    if (step && step !== 'any') await this.page.keyboard.press(isUp ? 'ArrowUp' : 'ArrowDown');
    else await type(this.page, text);
    await this.page.keyboard.press('Enter');
  }

  async placeGoal() {
    await focus(this.lab.canvas);
    await this.page.keyboard.press('ArrowRight');
    await this.page.keyboard.press('ArrowUp');
    await this.page.keyboard.press('Enter');
  }

  async dragBead() {
    const { keyboard } = this.page;
    await focus(this.lab.canvas);
    await keyboard.press('d');
    for (let i = 0; i < 4; i++) await keyboard.press('ArrowUp');
    await until('the hand', () => this.lab.state.hand_m);
    await keyboard.press('Escape');
  }
}
