// The dashboard as a person uses it: looks, mouse, keys. Only what is on the page and what came
// over its socket is read.

import { mkdir } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { check, until } from './harness.mjs';

export const OUTPUT = fileURLToPath(new URL('../../test-output/', import.meta.url));
/** A bead trailing its magnet cuts corners; farther from walls than this, it passes. */
const CLEARANCE_M = 0.025;
const STEP_M = 0.01;
const GOAL_RADIUS_M = 0.02;
const DELIVERY_MS = 90_000;
const HIDDEN_MS = 400;
const OPEN_MS = 30_000;

export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

export function distanceToSegment(point, a, b) {
  const along = [b[0] - a[0], b[1] - a[1]];
  const share = ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / distance(a, b) ** 2;
  const inside = Math.min(1, Math.max(0, share));
  return distance(point, [a[0] + inside * along[0], a[1] + inside * along[1]]);
}

function insideWall(scene, [x, y]) {
  return scene.walls.some(({ exterior, holes }) => {
    let crossings = 0;
    for (const ring of [exterior, ...holes]) {
      ring.forEach((a, i) => {
        const b = ring[(i + 1) % ring.length];
        const crosses = a[1] > y !== b[1] > y;
        if (crosses && x < a[0] + ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1])) crossings += 1;
      });
    }
    return crossings % 2 === 1;
  });
}

/** Whether a disc of CLEARANCE_M at `point` touches neither wall nor border. */
function isClear(scene, point) {
  const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
  for (const radius of [0, CLEARANCE_M / 2, CLEARANCE_M]) {
    for (let i = 0; i < 16; i++) {
      const angle = (i * Math.PI) / 8;
      const at = [point[0] + radius * Math.cos(angle), point[1] + radius * Math.sin(angle)];
      if (at[0] < x_min_m || at[0] > x_max_m || at[1] < y_min_m || at[1] > y_max_m) return false;
      if (insideWall(scene, at)) return false;
    }
  }
  return true;
}

export class Lab {
  /** Opens the page and waits until it is connected. */
  static async open(browser, url, options = {}) {
    const page = await browser.newPage({
      viewport: { width: 1280, height: 800 },
      colorScheme: 'dark',
      ...options,
    });
    try {
      return await Lab.attach(page, url);
    } catch (error) {
      // Left open it would keep its place in the session.
      await page.context().close();
      throw error;
    }
  }

  /** The same in a page that is there already. */
  static async attach(page, url) {
    const lab = new Lab(page);
    await page.goto(url);
    await until('the first state', () => lab.state && lab.scene, OPEN_MS);
    await until('live', async () => (await lab.text('connection')) === 'live', OPEN_MS);
    return lab;
  }

  constructor(page) {
    this.page = page;
    this.canvas = page.getByLabel('Workspace', { exact: true });
    /** What this page last sent of each type, and every event that it heard of. */
    this.sent = {};
    this.events = [];
    this.downloads = 0;
    page.on('download', () => (this.downloads += 1));
    page.on('websocket', (socket) => {
      socket.on('framesent', ({ payload }) => {
        const message = JSON.parse(payload);
        this.sent[message.type] = message;
        if (message.type === 'fork') this.comparison = undefined;
      });
      socket.on('framereceived', ({ payload }) => {
        if (typeof payload !== 'string') return;
        const message = JSON.parse(payload);
        if (message.type === 'hello') this.hello = message;
        if (message.type === 'scene') this.scene = message;
        if (message.type === 'state') this.state = message;
        if (message.type === 'overlay') this.overlay = message;
        if (message.type === 'comparison') this.comparison = message;
        if (message.type === 'event') this.events.push(message);
      });
    });
  }

  /** What came over the socket before is on the page, too: it is drawn in a frame. */
  drawn() {
    return this.page.evaluate(
      (hidden_ms) =>
        new Promise((done) => {
          if (document.hidden) setTimeout(done, hidden_ms);
          else requestAnimationFrame(() => requestAnimationFrame(done));
        }),
      HIDDEN_MS,
    );
  }

  async text(testid) {
    await this.drawn();
    return this.page.getByTestId(testid).innerText();
  }

  async number(testid) {
    return Number(await this.text(testid));
  }

  button(name) {
    return this.page.getByRole('button', { name, exact: true });
  }

  notice(place) {
    return this.page.locator(`[data-place=${place}] .notice`);
  }

  async point(name) {
    await this.drawn();
    const text = await this.canvas.getAttribute(`data-${name}`);
    return text ? text.split(',').map(Number) : undefined;
  }

  /** Position on the page, in CSS pixels, of a point of the table. */
  async px([x, y]) {
    await this.canvas.scrollIntoViewIfNeeded();
    await until('a view', () => this.canvas.getAttribute('data-px-per-m'));
    const box = await this.canvas.boundingBox();
    const data = await this.canvas.evaluate((canvas) => ({ ...canvas.dataset }));
    return [
      box.x + Number(data.originX) + x * Number(data.pxPerM),
      box.y + Number(data.originY) - y * Number(data.pxPerM),
    ];
  }

  /** What a little of the page looks like around a point of the table. */
  async look(point) {
    const [x, y] = await this.px(point);
    const clip = { x: Math.round(x), y: Math.round(y), width: 2, height: 2 };
    return (await this.page.screenshot({ clip })).toString('base64');
  }

  /** Shows a layer or hides it, and leaves the menu closed: it covers some of the map. */
  async layer(name, on = true) {
    await this.button('Layers').click();
    const layers = this.page.getByRole('group', { name: 'Layers' });
    await layers.getByLabel(name, { exact: true }).setChecked(on);
    await this.page.keyboard.press('Escape');
    await this.page.getByRole('group', { name: 'Layers' }).waitFor({ state: 'detached' });
  }

  async click(point) {
    await this.page.mouse.click(...(await this.px(point)));
  }

  async reset({ speed = '1', map = 'posts' } = {}) {
    if (this.scene.map !== map) {
      await this.page.getByLabel('Map', { exact: true }).selectOption(map);
      await until(`map ${map}`, () => this.scene.map === map);
    }
    // It may stand at tick 0 already.
    const { trial } = this.scene;
    await this.button('Reset').click();
    await until('another trial', () => this.scene.trial !== trial && this.state.tick === 0);
    await until('tick 0', async () => (await this.text('tick')) === 'tick 0');
    await this.speed(speed);
  }

  async speed(factor) {
    await this.page.getByLabel('Speed', { exact: true }).selectOption(factor);
  }

  /** Waits for the goal that is the `count`th since the reset. */
  async delivered(count) {
    await until(
      `delivery ${count}`,
      async () => (await this.number('deliveries')) === count,
      DELIVERY_MS,
    );
    const left = distance(await this.point('bead'), await this.point('goal'));
    check(left <= GOAL_RADIUS_M, `the bead is ${left} m from the goal`);
  }

  run() {
    return this.button('Run').click();
  }

  /** The session stands when this returns. */
  async pause() {
    await this.button('Pause').click();
    await until('paused', () => !this.state.running);
  }

  /** Free points, those with the shortest straight free way from `from` to walk first. */
  freePoints(from, least_m, most_m) {
    const { x_min_m, x_max_m, y_min_m, y_max_m } = this.scene.workspace;
    const points = [];
    for (let x = x_min_m; x <= x_max_m; x += 0.02) {
      for (let y = y_min_m; y <= y_max_m; y += 0.02) {
        const away = distance([x, y], from);
        if (away >= least_m && away <= most_m && isClear(this.scene, [x, y])) {
          points.push({ at: [x, y], blocked: this.blockedShare(from, [x, y]), away });
        }
      }
    }
    points.sort((a, b) => a.blocked - b.blocked || a.away - b.away);
    check(points.length > 0, `no free point ${least_m} to ${most_m} m from ${from}`);
    return points.map(({ at }) => at);
  }

  blockedShare(a, b) {
    const steps = Math.ceil(distance(a, b) / STEP_M);
    let blocked = 0;
    for (let i = 1; i <= steps; i++) {
      const share = i / steps;
      const at = [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
      if (!isClear(this.scene, at)) blocked += 1;
    }
    return blocked / steps;
  }

  /** The middle of some wall that a click can hit. */
  wallPoint() {
    const { x_min_m, x_max_m, y_min_m, y_max_m } = this.scene.workspace;
    for (let x = x_min_m + 0.01; x < x_max_m; x += STEP_M) {
      for (let y = y_min_m + 0.01; y < y_max_m; y += STEP_M) {
        const around = [
          [x, y],
          [x - 0.004, y],
          [x + 0.004, y],
          [x, y - 0.004],
          [x, y + 0.004],
        ];
        if (around.every((point) => insideWall(this.scene, point))) return [x, y];
      }
    }
    throw new Error('the map has no wall inside');
  }

  async screenshot(name, options = {}) {
    await mkdir(OUTPUT, { recursive: true });
    await this.page.screenshot({ path: `${OUTPUT}web-${name}.png`, ...options });
  }

  /** A picture of a part of the page, from its beginning. */
  async shoot(locator, name) {
    await mkdir(OUTPUT, { recursive: true });
    await locator.evaluate((part) => {
      for (const one of part.querySelectorAll('*')) one.scrollTop = 0;
    });
    await locator.screenshot({ path: `${OUTPUT}${name}.png` });
  }
}
