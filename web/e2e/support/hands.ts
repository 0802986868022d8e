// The ways to operate a control: by mouse, by touch, by keyboard alone.

import type { Locator } from '@playwright/test';
import type { Lab } from './lab';
import type { Point } from './table';
import { until } from './wait';

type Px = readonly [number, number];

/** Text fields take letters from the keyboard by whatever hand they were focused. */
async function enter(hand: Hand, text: string) {
  await hand.page.keyboard.press('Control+a');
  await hand.page.keyboard.type(text);
}

/** Where to drag a slider: to the side with more room. */
async function slideOf(lab: Lab, locator: Locator): Promise<[Px, Px]> {
  const box = await lab.boxOf(locator);
  const share = await locator.evaluate(
    (one: HTMLInputElement) =>
      (one.valueAsNumber - Number(one.min)) / (Number(one.max) - Number(one.min)),
  );
  const at = (part: number): Px => [box.x + part * box.width, box.y + box.height / 2];
  return [at(Math.min(0.95, Math.max(0.05, share))), at(share > 0.5 ? 0.25 : 0.75)];
}

/** The native list of a select is open: the next option, or the one before the last. */
async function chooseNext(hand: Hand, locator: Locator) {
  const isLast = await locator.evaluate(
    (one: HTMLSelectElement) => one.selectedIndex === one.options.length - 1,
  );
  await hand.page.keyboard.press(isLast ? 'ArrowUp' : 'ArrowDown');
}

/** The set that a radio or a tab is one of. */
export const setOf = (locator: Locator) =>
  locator.locator('xpath=ancestor::*[@role="tablist" or @role="radiogroup"][1]');

export const isChosen = (locator: Locator) =>
  locator.evaluate(
    (one: HTMLInputElement) => one.checked || one.getAttribute('aria-selected') === 'true',
  );

/** A disabled control takes no focus, and the next key would go to what had it before. */
async function focus(locator: Locator) {
  await until('the focus', async () => {
    await locator.focus();
    return locator.evaluate((one) => one === document.activeElement);
  });
}

export abstract class Hand {
  abstract readonly name: 'mouse' | 'touch' | 'keyboard';

  constructor(readonly lab: Lab) {}

  get page() {
    return this.lab.page;
  }

  abstract press(locator: Locator): Promise<void>;
  abstract slide(locator: Locator): Promise<void>;
  abstract type(locator: Locator, text: string): Promise<void>;
  abstract placeGoal(point: Point): Promise<void>;
  abstract dragBead(): Promise<void>;

  /** A radio or a tab. Another one of its set has to be chosen before. */
  pick(locator: Locator) {
    return this.press(locator);
  }

  async choose(locator: Locator) {
    await this.press(locator);
    await chooseNext(this, locator);
    await this.page.keyboard.press('Enter');
  }
}

/** Mouse and touch: both drag. */
abstract class Pointer extends Hand {
  abstract drag(from: Px, to: Px, whileHeld?: () => Promise<unknown>): Promise<void>;

  async slide(locator: Locator) {
    await this.drag(...(await slideOf(this.lab, locator)));
  }

  async dragBead() {
    const { lab } = this;
    const bead = await lab.bead();
    const to = lab.freePoints(bead, 0.03, 0.08)[0];
    await this.drag(await lab.px(bead), await lab.px(to), () =>
      until('the hand', () => lab.state.hand_m),
    );
  }
}

class Mouse extends Pointer {
  readonly name = 'mouse';

  async press(locator: Locator) {
    await locator.click();
  }

  async drag(from: Px, to: Px, whileHeld?: () => Promise<unknown>) {
    const { mouse } = this.page;
    await mouse.move(...from);
    await mouse.down();
    await mouse.move(...to, { steps: 4 });
    await whileHeld?.();
    await mouse.up();
  }

  async type(locator: Locator, text: string) {
    await locator.click();
    await enter(this, text);
    await this.page.keyboard.press('Tab');
  }

  async placeGoal(point: Point) {
    await this.lab.click(point);
  }
}

class Touch extends Pointer {
  readonly name = 'touch';

  async press(locator: Locator) {
    await locator.tap();
  }

  async drag(from: Px, to: Px, whileHeld?: () => Promise<unknown>) {
    const cdp = await this.page.context().newCDPSession(this.page);
    const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', points: readonly Px[]) =>
      cdp.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: points.map(([x, y]) => ({ x, y })),
      });
    await send('touchStart', [from]);
    for (const share of [0.25, 0.5, 0.75, 1]) {
      await send('touchMove', [
        [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])],
      ]);
    }
    await whileHeld?.();
    // A finger that lifts while it moves scrolls on, and the next tap would only stop that.
    for (let i = 0; i < 4; i++) {
      await this.lab.drawn();
      await send('touchMove', [to]);
    }
    await send('touchEnd', []);
    await cdp.detach();
  }

  async type(locator: Locator, text: string) {
    await locator.tap();
    await enter(this, text);
    await this.page.keyboard.press('Enter');
  }

  async placeGoal(point: Point) {
    await this.page.touchscreen.tap(...(await this.lab.px(point)));
  }
}

/** The focus is set here; that Tab reaches everything is another test. */
class Keyboard extends Hand {
  readonly name = 'keyboard';

  async press(locator: Locator) {
    await focus(locator);
    const isBox = await locator.evaluate((one: HTMLInputElement) => one.type === 'checkbox');
    await this.page.keyboard.press(isBox ? ' ' : 'Enter');
  }

  /** By arrows, from the one that is chosen now. */
  override async pick(locator: Locator) {
    const role = await locator.evaluate(
      (one: HTMLInputElement) => one.getAttribute('role') ?? one.type,
    );
    const all = await setOf(locator)
      .getByRole(role as 'radio' | 'tab')
      .all();
    let isAny = false;
    for (const one of all) {
      if (!(await isChosen(one))) continue;
      await focus(one);
      isAny = true;
    }
    if (!isAny) {
      await focus(locator);
      await this.page.keyboard.press(' ');
    }
    for (let pressed = 0; pressed < all.length && !(await isChosen(locator)); pressed++) {
      await this.page.keyboard.press('ArrowRight');
    }
  }

  override async choose(locator: Locator) {
    await focus(locator);
    await chooseNext(this, locator);
  }

  async slide(locator: Locator) {
    await focus(locator);
    const isHigh = await locator.evaluate(
      (one: HTMLInputElement) =>
        one.valueAsNumber - Number(one.min) > (Number(one.max) - Number(one.min)) / 2,
    );
    await this.page.keyboard.press(isHigh ? 'ArrowLeft' : 'ArrowRight');
  }

  /** One step by arrow where the field has steps, else by digits. */
  async type(locator: Locator, text: string) {
    await focus(locator);
    const { step, isUp } = await locator.evaluate(
      (one: HTMLInputElement, wish) => ({
        step: one.step,
        isUp: Number(wish) > one.valueAsNumber,
      }),
      text,
    );
    if (step && step !== 'any') await this.page.keyboard.press(isUp ? 'ArrowUp' : 'ArrowDown');
    else await enter(this, text);
    await this.page.keyboard.press('Enter');
  }

  async placeGoal() {
    await focus(this.lab.canvas);
    for (const key of ['ArrowRight', 'ArrowUp', 'Enter']) await this.page.keyboard.press(key);
  }

  async dragBead() {
    await focus(this.lab.canvas);
    await this.page.keyboard.press('d');
    for (let i = 0; i < 4; i++) await this.page.keyboard.press('ArrowUp');
    await until('the hand', () => this.lab.state.hand_m);
    await this.page.keyboard.press('Escape');
  }
}

export const HANDS = { mouse: Mouse, keyboard: Keyboard, touch: Touch };
