// Input methods that operate a control: by mouse, by touch, by keyboard only.

import type { Locator } from '@playwright/test';
import type { Lab } from './lab';
import type { Point } from './table';
import { until } from './wait';

type Px = readonly [number, number];

/** Replaces the text of the focused field. Every input method types on the keyboard. */
async function replaceText(input: InputMethod, text: string) {
  await input.page.keyboard.press('Control+a');
  await input.page.keyboard.type(text);
}

/** Start and end of a drag of a slider: from the thumb to the side with more room. */
async function sliderDrag(lab: Lab, locator: Locator): Promise<[Px, Px]> {
  const box = await lab.boxOf(locator);
  const share = await locator.evaluate(
    (one: HTMLInputElement) =>
      (one.valueAsNumber - Number(one.min)) / (Number(one.max) - Number(one.min)),
  );
  const at = (part: number): Px => [box.x + part * box.width, box.y + box.height / 2];
  return [at(Math.min(0.95, Math.max(0.05, share))), at(share > 0.5 ? 0.25 : 0.75)];
}

/** Chooses the next option of the focused select; from the last option, the previous one. */
async function chooseNext(input: InputMethod, locator: Locator) {
  const isLast = await locator.evaluate(
    (one: HTMLSelectElement) => one.selectedIndex === one.options.length - 1,
  );
  await input.page.keyboard.press(isLast ? 'ArrowUp' : 'ArrowDown');
}

/** The radio group or the tab list that contains a radio or a tab. */
export const setOf = (locator: Locator) =>
  locator.locator('xpath=ancestor::*[@role="tablist" or @role="radiogroup"][1]');

export const isChosen = (locator: Locator) =>
  locator.evaluate(
    (one: HTMLInputElement) => one.checked || one.getAttribute('aria-selected') === 'true',
  );

/** Waits for the focus: a disabled control takes none, and the next key would go elsewhere. */
async function focus(locator: Locator) {
  await until('the focus', async () => {
    await locator.focus();
    return locator.evaluate((one) => one === document.activeElement);
  });
}

export abstract class InputMethod {
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

  /** Chooses a radio or a tab. Another one of its set must be chosen before. */
  pick(locator: Locator) {
    return this.press(locator);
  }

  async choose(locator: Locator) {
    await this.press(locator);
    await chooseNext(this, locator);
    await this.page.keyboard.press('Enter');
  }
}

/** Mouse and touch, which both drag. */
abstract class Pointer extends InputMethod {
  abstract drag(from: Px, to: Px, whileHeld?: () => Promise<unknown>): Promise<void>;

  async slide(locator: Locator) {
    await this.drag(...(await sliderDrag(this.lab, locator)));
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
    await mouse.move(...to, { steps: 2 });
    await whileHeld?.();
    await mouse.up();
  }

  async type(locator: Locator, text: string) {
    await locator.click();
    await replaceText(this, text);
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
    for (const share of [0.5, 1]) {
      await send('touchMove', [
        [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])],
      ]);
    }
    if (whileHeld) {
      await whileHeld();
      // A finger that lifts while it moves makes the page scroll on, and the next tap would only
      // stop that. So the finger rests before it lifts. A slider does not scroll.
      for (let i = 0; i < 2; i++) {
        await this.lab.drawn();
        await send('touchMove', [to]);
      }
    }
    await send('touchEnd', []);
    await cdp.detach();
  }

  async type(locator: Locator, text: string) {
    await locator.tap();
    await replaceText(this, text);
    await this.page.keyboard.press('Enter');
  }

  async placeGoal(point: Point) {
    await this.page.touchscreen.tap(...(await this.lab.px(point)));
  }
}

/** Sets the focus by script. That Tab reaches each control is tested in appearance.spec.ts. */
class Keyboard extends InputMethod {
  readonly name = 'keyboard';

  async press(locator: Locator) {
    await focus(locator);
    const isBox = await locator.evaluate((one: HTMLInputElement) => one.type === 'checkbox');
    await this.page.keyboard.press(isBox ? ' ' : 'Enter');
  }

  /** Presses arrow keys, beginning at the chosen one. */
  override async pick(locator: Locator) {
    const role = await locator.evaluate(
      (one: HTMLInputElement) => one.getAttribute('role') ?? one.type,
    );
    const all = await setOf(locator)
      .getByRole(role as 'radio' | 'tab')
      .all();
    let hasChosen = false;
    for (const one of all) {
      if (!(await isChosen(one))) continue;
      await focus(one);
      hasChosen = true;
    }
    if (!hasChosen) {
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

  /** Presses an arrow key once in a number field, and types digits elsewhere. */
  async type(locator: Locator, text: string) {
    await focus(locator);
    const isUp = Number(text) > Number(await locator.inputValue());
    const isNumber = (await locator.getAttribute('role')) === 'spinbutton';
    if (isNumber) await this.page.keyboard.press(isUp ? 'ArrowUp' : 'ArrowDown');
    else await replaceText(this, text);
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

export const INPUT_METHODS = { mouse: Mouse, keyboard: Keyboard, touch: Touch };
