// Walls that move: the plan view, the 3-D view and saved pictures show them where they are.

import { LONG, type Lab, expect, test } from './fixtures';
import { colour, decode, RATIO, saved } from './support/pictures';
import { CONTROL_STEP_TICKS, SECOND_TICKS } from './support/stepper';
import { openSceneView } from './support/preconditions';
import { gpuObjects, px, settled } from './support/scene';
import { distance, type Point } from './support/table';
import { until } from './support/wait';
import type { Lumen } from './support/wire';

/** The wall is at least this far from its place at rest, and the pixels that are read half as far. */
const MOVED_M = 0.006;
/** Marks of the tool and the camera are nearer to the tool. */
const APART_M = 0.2;

interface Spot {
  /** On the free side of a wall at rest. */
  readonly at: Point;
  /** How far that wall has closed in. */
  readonly closing_m: (wave_m: readonly number[]) => number;
}

/** A place that the walls cover for a part of each period. */
async function spotOf(lab: Lab): Promise<Spot> {
  const lumen = await lab.page.evaluate(async (name) => {
    const answer = await fetch(`/api/sessions/${name}/lumen`);
    return (await answer.json()) as Lumen;
  }, lab.hello.session);
  const [toolX, toolY] = lab.state.tool_m;
  for (const { place_m, along_m, limit_m } of lumen.rings) {
    for (const [i, at] of place_m.entries()) {
      const [before, after] = [place_m.at(i - 1) ?? at, place_m[i + 1] ?? at];
      const [along, limit] = [along_m[i] ?? 0, limit_m[i] ?? 0];
      const span_m = distance(before, after);
      const isStraight = span_m > 0.99 * (distance(before, at) + distance(at, after)) && span_m > 0;
      if (!isStraight || limit < 2 * MOVED_M || distance(at, [toolX, toolY]) < APART_M) continue;
      const knot = Math.floor(along / lumen.knot_m);
      // The free space is on the left.
      const share = MOVED_M / 2 / span_m;
      return {
        at: [at[0] - share * (after[1] - before[1]), at[1] + share * (after[0] - before[0])],
        closing_m: (wave_m) => Math.min(wave_m[knot] ?? 0, wave_m[knot + 1] ?? 0, limit),
      };
    }
  }
  throw new Error('no wall that moves far from the tool');
}

const closing = (lab: Lab, spot: Spot) => spot.closing_m(lab.state.wave_m ?? []);

async function amplitude(lab: Lab, millimetres: string) {
  await lab.tune('Amplitude', millimetres);
  const wanted_m = Number(millimetres) / 1000;
  await until('the amplitude', () => {
    const now_m = lab.scene.parameters.peristalsis_amplitude_m;
    return Math.abs(now_m - wanted_m) < 1e-9;
  });
}

/** Steps until the wall covers the spot. */
const cover = (lab: Lab, spot: Spot) =>
  lab.stepUntil('a covered spot', () => closing(lab, spot) > MOVED_M + 0.002, CONTROL_STEP_TICKS);

/** Lets the walls come to rest. */
async function rest(lab: Lab) {
  await amplitude(lab, '0');
  await lab.stepUntil('walls at rest', () => lab.state.wave_m === undefined);
}

/** The pixel of the plan view at a place. */
async function planPixel(lab: Lab, at: Point) {
  const [x, y] = await lab.px(at);
  const { x: left, y: top } = await lab.boxOf(lab.canvas);
  return lab.canvas.evaluate(
    (canvas: HTMLCanvasElement, [px, py]) => {
      const ctx = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
      const ratio = window.devicePixelRatio;
      ctx?.drawImage(canvas, -Math.floor(px * ratio), -Math.floor(py * ratio));
      return [...(ctx?.getImageData(0, 0, 1, 1).data ?? [])].slice(0, 3);
    },
    [x - left, y - top] as const,
  );
}

const WALL = ['--wall', '--wall-deep', '--wall-lip', '--wall-rim'];
/** Opacity of the shadow of a wall on the floor. */
const SHADE = 0.3;

/** Tells pixels of a wall, which has a relief, from those of the floor, which may lie in the shadow. */
async function wallOrFloor(lab: Lab) {
  const wall = await Promise.all(WALL.map((name) => colour(lab, name)));
  const [floor, shade] = [await colour(lab, '--floor'), await colour(lab, '--wall-shade')];
  const shaded = floor.map((value, i) => (1 - SHADE) * value + SHADE * (shade[i] ?? NaN));
  const apart = (a: readonly number[], b: readonly number[]) =>
    Math.hypot(...a.map((value, i) => value - (b[i] ?? NaN)));
  const nearest = (pixel: readonly number[], all: readonly (readonly number[])[]) =>
    Math.min(...all.map((one) => apart(pixel, one)));
  return (pixel: readonly number[]) => nearest(pixel, wall) < nearest(pixel, [floor, shaded]);
}

/** A picture of the 3-D view around a place. */
async function scenePicture(lab: Lab, at: Point) {
  await settled(lab);
  const [x, y] = await px(lab, at);
  const clip = { x: Math.round(x) - 6, y: Math.round(y) - 6, width: 12, height: 12 };
  return lab.page.screenshot({ clip });
}

/** Opens the parameters of the walls. */
async function openWalls(lab: Lab) {
  await lab.panel('Tune');
  await lab.page
    .locator('summary')
    .filter({ hasText: /^Walls and fluid/ })
    .click();
}

async function prepare(lab: Lab) {
  await lab.reset({ map: 'colon' });
  await openWalls(lab);
  await lab.tune('Period', '20');
  await until('the period', () => lab.scene.parameters.peristalsis_period_s === 20);
  return spotOf(lab);
}

test('draws the moving walls in the plan view', async ({ lab }) => {
  const spot = await prepare(lab);
  const isWallPixel = await wallOrFloor(lab);
  const isWall = async () => isWallPixel(await planPixel(lab, spot.at));
  const hint = lab.page.locator('.wall-hint');
  expect(await isWall(), 'a wall before it moves').toBe(false);
  await amplitude(lab, '20');
  await cover(lab, spot);
  await until('the moved wall', isWall);
  await lab.page.mouse.move(...(await lab.px(spot.at)));
  await expect(hint).toBeVisible();

  const { bytes } = await saved(lab, 'Picture (PNG)');
  const [x, y] = await lab.px(spot.at);
  const { x: left, y: top } = await lab.boxOf(lab.canvas);
  const at = [RATIO * (x - left), RATIO * (y - top)] as const;
  const { around } = await decode(lab.page, bytes, at, 1);
  expect(around.every(isWallPixel)).toBe(true);
  await lab.page.keyboard.press('Escape');

  await rest(lab);
  await until('the free place', async () => !(await isWall()));
  await lab.page.mouse.move(...(await lab.px(spot.at)));
  await expect(lab.page.locator('.readout')).toContainText('m');
  await expect(hint).toHaveCount(0);
});

/** A link of the arm gets an outline when it covers the bead for the first time: twice is enough. */
const MOST_MOTIONS = 4;

test('draws the moving walls in the 3-D view, and frees them at rest', LONG, async ({ lab }) => {
  test.setTimeout(400_000);
  const spot = await prepare(lab);
  await openSceneView(lab);
  // From the front, a wall would hide the places behind it.
  await lab.button('Top').click();
  // Trails have objects, too.
  for (let i = 0; i < 5; i++) await lab.step(10);
  const free = await scenePicture(lab, spot.at);
  let before: readonly number[] | undefined;
  let objects: readonly number[] = await gpuObjects(lab);
  for (let motion = 0; objects.join() !== before?.join(); motion++) {
    expect(motion, 'the objects become more with every motion').toBeLessThan(MOST_MOTIONS);
    before = objects;
    await amplitude(lab, '20');
    await cover(lab, spot);
    const covered = await scenePicture(lab, spot.at);
    expect(covered.equals(free), 'the picture has not changed').toBe(false);
    const more = await gpuObjects(lab);
    expect(more[0]).toBeGreaterThan(objects[0] ?? 0);

    // Another theme uses the same objects.
    await lab.button('Light').click();
    await settled(lab);
    await lab.button('Dark').click();
    expect(await gpuObjects(lab)).toEqual(more);
    expect((await scenePicture(lab, spot.at)).equals(covered)).toBe(true);

    await rest(lab);
    await until('the free place', async () => (await scenePicture(lab, spot.at)).equals(free));
    objects = await gpuObjects(lab);
  }
});

test('keeps the actions of the workspace while the walls move', async ({ lab }) => {
  await lab.reset({ map: 'colon' });
  await openWalls(lab);
  await amplitude(lab, '6');
  const isMoving = () => Math.max(...(lab.state.wave_m ?? [0])) > 0.004;
  await lab.stepUntil('moving walls', isMoving, CONTROL_STEP_TICKS);
  const goal = await lab.setGoal(lab.freePoints(await lab.bead(), 0.05, 0.2)[0]);
  await lab.startDrag(goal);
  await lab.page.mouse.up();
  await until('no hand', () => !lab.state.hand_m);
});

test('says once that the walls cannot be drawn, and asks again after a rest', async ({
  lab,
  watch,
}) => {
  watch.allow(/Failed to load resource/);
  let requests = 0;
  let isBroken = true;
  await lab.page.route('**/lumen', async (route) => {
    requests += 1;
    await (isBroken ? route.fulfill({ status: 503, body: '' }) : route.continue());
  });
  await lab.reset({ map: 'colon' });
  await openWalls(lab);
  await amplitude(lab, '6');
  await lab.step(SECOND_TICKS);
  const notice = lab.notice('workspace').filter({ hasText: 'The moving walls cannot be drawn' });
  await notice.waitFor();
  for (let i = 0; i < 5; i++) await lab.step(50);
  expect(requests).toBe(1);
  await rest(lab);
  isBroken = false;
  await amplitude(lab, '6');
  await lab.step(SECOND_TICKS);
  await until('another request', () => requests === 2);
});

test('shows a viewer the moving walls', LONG, async ({ lab, openLab }) => {
  const spot = await prepare(lab);
  await amplitude(lab, '20');
  await cover(lab, spot);
  const viewer = await openLab();
  await viewer.isRole('viewer');
  const isWallPixel = await wallOrFloor(viewer);
  const isWall = async () => isWallPixel(await planPixel(viewer, spot.at));
  await until('the moved wall', isWall);
  // The layout of a phone: the plan is smaller.
  await viewer.page.setViewportSize({ width: 390, height: 844 });
  await until('the moved wall', isWall);
});
