// Operates the page as an operator does. Reads only the page and the messages of its WebSocket.

import { type Locator, type Page, expect } from '@playwright/test';
import { LabControls } from './labControls';
import { keepSocket } from './stepper';
import { countGpu } from './shown';
import { type Point, type PointLike, distance, flat, freePoints, wallPoint } from './table';
import { must, until } from './wait';

const GOAL_RADIUS_M = 0.02;
const OPEN_MS = 30_000;
const DELIVERY_MS = 60_000;
export type ControllerLabel = 'RL' | 'ERRT' | 'Attractor' | 'You';

/** The page opens as on a later visit, without the scene that begins the first one. */
export const skipFirstVisit = (page: Page) =>
  page.addInitScript(() => {
    // An empty page has no storage.
    if (location.host !== '') localStorage.setItem('ferry.visit', 'done');
  });

export class Lab extends LabControls {
  /** Opens a session's page and waits until it is connected. */
  static async attach(page: Page, url: string) {
    const lab = await Lab.watch(page, url);
    await lab.live();
    return lab;
  }

  /** Opens a page and waits for nothing. */
  static async watch(page: Page, url: string) {
    const lab = new Lab(page);
    await page.addInitScript(keepSocket);
    await page.addInitScript(countGpu);
    await skipFirstVisit(page);
    await page.goto(url);
    return lab;
  }

  async live() {
    await until('the first messages', () => this.isComplete, OPEN_MS);
    await this.isConnection('live');
  }

  async text(testid: string) {
    await this.drawn();
    return this.page.getByTestId(testid).innerText();
  }

  async number(testid: string) {
    return Number((await this.text(testid)).replace('−', '-'));
  }

  async isConnection(state: 'live' | 'lost' | 'outdated' | 'ended') {
    await expect(this.page.getByTestId('connection')).toHaveAttribute('data-link', state, {
      timeout: OPEN_MS,
    });
  }

  async isRole(role: 'operator' | 'viewer') {
    await expect(this.page.getByTestId('connection')).toHaveAttribute('data-role', role, {
      timeout: OPEN_MS,
    });
  }

  /** Waits until the page shows the state of a tick. */
  async isAtTick(tick: number) {
    await expect(this.page.getByTestId('sim-time')).toHaveAttribute('title', `Tick ${tick}`);
  }

  /** Where the goal of the shown state is, in metres. */
  async goal(): Promise<Point | undefined> {
    await this.drawn();
    return this.state.goal_m ? flat(this.state.goal_m) : undefined;
  }

  /** Where the bead of the shown state is. */
  async bead(): Promise<Point> {
    await this.drawn();
    return flat(this.state.bead_m);
  }

  /** Scrolls to an element and returns its box on the page, once two frames show the same box. */
  async boxOf(locator: Locator) {
    await locator.waitFor();
    return locator.evaluate(async (element) => {
      const nextFrame = () => new Promise((done) => requestAnimationFrame(done));
      const box = () => {
        const { x, y, width, height } = element.getBoundingClientRect();
        return { x, y, width, height };
      };
      element.scrollIntoView({ block: 'nearest', inline: 'nearest' });
      let before;
      let now = box();
      do {
        before = now;
        await nextFrame();
        await nextFrame();
        now = box();
      } while (JSON.stringify(now) !== JSON.stringify(before));
      return now;
    });
  }

  /** Position on the page, in CSS pixels, of a point of the table. */
  async px([x, y]: PointLike): Promise<[number, number]> {
    await expect(this.canvas).toHaveAttribute('data-px-per-m');
    const box = await this.boxOf(this.canvas);
    const [originX, originY, pxPerM] = await this.canvas.evaluate(({ dataset }) =>
      [dataset.originX, dataset.originY, dataset.pxPerM].map(Number),
    );
    return [
      box.x + (originX ?? NaN) + x * (pxPerM ?? NaN),
      box.y + (originY ?? NaN) - y * (pxPerM ?? NaN),
    ];
  }

  /** A picture of the page's rectangle around some points of the table. */
  async pixelsAround(...points: readonly PointLike[]) {
    const at: Point[] = [];
    for (const point of points) at.push(await this.px(point));
    const [left, top] = [0, 1].map((axis) =>
      Math.round(Math.min(...at.map((one) => one[axis] ?? 0))),
    );
    const [right, bottom] = [0, 1].map((axis) =>
      Math.round(Math.max(...at.map((one) => one[axis] ?? 0))),
    );
    const [x, y] = [left ?? 0, top ?? 0];
    const clip = { x, y, width: (right ?? 0) - x + 2, height: (bottom ?? 0) - y + 2 };
    return (await this.page.screenshot({ clip })).toString('base64');
  }

  /** Shows or hides a layer, and closes the panel of the layers. */
  async layer(name: string, on = true) {
    await this.button('Layers').click();
    const layers = this.page.getByRole('group', { name: 'Layers' });
    await layers.getByLabel(name, { exact: true }).setChecked(on);
    await this.button('Layers').click();
    await expect(layers).toHaveCount(0);
  }

  async click(point: PointLike) {
    await this.page.mouse.click(...(await this.px(point)));
  }

  /** Waits for a message of the server, and until the page shows it: what is done next relies on the page. */
  private async shown<T>(what: string, probe: () => T | Promise<T>) {
    const value = await until(what, probe);
    await this.drawn();
    return value;
  }

  /** Clicks a free point and waits until it is the goal. */
  async setGoal(goal: PointLike) {
    await this.click(goal);
    return this.shown('the goal', () => {
      const set = this.state.goal_m;
      return set && distance(set, goal) < 0.005 && set;
    });
  }

  async map(name: string) {
    if (this.scene.map === name) return;
    // A drawing that was added opens it.
    if ((await this.setUpButton.getAttribute('aria-expanded')) === 'false') await this.setUp();
    await this.mapChoice(name).check();
    await this.setUp();
    await this.shown(`map ${name}`, () => this.scene.map === name);
  }

  async reset({ speed = '1', map = 'posts' } = {}) {
    await this.map(map);
    // The tick may be 0 already, so wait for another trial.
    const { trial } = this.scene;
    await this.button('Reset').click();
    await until('another trial', () => this.scene.trial !== trial && this.state.tick === 0);
    await this.isAtTick(0);
    await this.speed(speed);
  }

  async speed(factor: string) {
    await this.label('Speed').selectOption(factor);
  }

  async controller(name: ControllerLabel) {
    await this.radio(name).check();
    await this.shown(name, () => this.state.controller === name.toLowerCase());
  }

  /** Advances a paused session to delivery number `count` since the reset. */
  async deliver(count = 1) {
    await this.stepUntil('a delivery', () => this.state.deliveries >= count);
    await this.delivered(count);
  }

  /** Waits for delivery number `count` since the reset. */
  async delivered(count: number) {
    await expect(this.page.getByTestId('deliveries')).toHaveText(String(count), {
      timeout: DELIVERY_MS,
    });
    const distance_m = distance(await this.bead(), must(await this.goal(), 'the goal'));
    expect(distance_m, 'distance from bead to goal in metres').toBeLessThanOrEqual(GOAL_RADIUS_M);
  }

  async run() {
    await this.button('Run').click();
    await this.shown('running', () => this.state.running);
  }

  async pause() {
    await this.button('Pause').click();
    await this.shown('paused', () => !this.state.running);
  }

  /** Waits until the session has run for `ticks` more ticks. */
  async later(ticks: number) {
    const { tick } = this.state;
    await until(`${ticks} ticks later`, () => this.state.tick >= tick + ticks);
  }

  async releaseControl() {
    await this.button('More').click();
    await this.button('Release control').click();
    await this.isRole('viewer');
  }

  async takeControl() {
    await this.button('Take control').click();
    await this.isRole('operator');
  }

  async restoreDefaults() {
    await this.panel('Tune');
    // The page restores what it shows as changed.
    await this.drawn();
    await this.button('Restore defaults').click();
    await until('the defaults', () => {
      const { defaults, parameters } = this.scene;
      return JSON.stringify(parameters) === JSON.stringify(defaults);
    });
    await this.drawn();
  }

  /** Types the value of a parameter into its field. */
  async tune(name: string, value: string) {
    await this.panel('Tune');
    await this.spin(name).fill(value);
    await this.spin(name).press('Enter');
  }

  freePoints(from: PointLike, min_m: number, max_m: number) {
    return freePoints(this.scene, from, min_m, max_m);
  }

  wallPoint() {
    return wallPoint(this.scene);
  }

  /** Drags the bead by mouse to a point of the table, and keeps the button pressed. */
  async startDrag(to: PointLike) {
    const { mouse } = this.page;
    await mouse.move(...(await this.px(await this.bead())));
    await mouse.down();
    await mouse.move(...(await this.px(to)), { steps: 6 });
    await until('the hand', () => this.state.hand_m);
  }
}
