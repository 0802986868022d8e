// The controller You: a person steers the tool by mouse, touch, keys and gamepad, and sees what the controllers see.

import { LONG, type Lab, expect, test } from './fixtures';
import { TABLET } from './support/browser';
import { CONTROL_STEP_TICKS, SECOND_TICKS } from './support/stepper';
import { HANDS, injectGamepad } from './support/steering';
import { type Point, distance } from './support/table';
import { must, until } from './support/wait';

const DELIVERY_MS = 60_000;
/** On a path, the hand points this far ahead of the tool. */
const AHEAD_M = 0.02;

const tool = (lab: Lab): Point => [lab.state.tool_m[0], lab.state.tool_m[1]];

/** A trial with the controller You and a goal that was chosen with the button. */
async function begin(lab: Lab, goal: Point) {
  await lab.reset({ map: lab.scene.map });
  await lab.radio('You').check();
  await until('You', () => lab.state.controller === 'you');
  await lab.button('Set goal').click();
  await lab.click(goal);
  await until('the goal', () => lab.state.goal_m && distance(lab.state.goal_m, goal) < 0.005);
}

/** The same, running. */
async function beginAtSpeed(lab: Lab, goal: Point, speed = '4') {
  await begin(lab, goal);
  await lab.speed(speed);
  await lab.run();
}

/** A place near the bead with nothing in between. */
const goalNear = async (lab: Lab) => lab.freePoints(await lab.bead(), 0.06, 0.15)[0];

const toGo = (lab: Lab, goal: Point): Point => [
  goal[0] - lab.state.tool_m[0],
  goal[1] - lab.state.tool_m[1],
];

/** The tool comes to rest. On a busy machine the browser may take long to notice what the hand does. */
const rests = (lab: Lab) =>
  until('the tool at rest', async () => {
    const before = tool(lab);
    await lab.later(125);
    return distance(tool(lab), before) < 0.002;
  });

test('delivers by mouse, and the tool goes no further than the hand points', async ({ lab }) => {
  const { mouse } = lab.page;
  await lab.reset();
  const goal = await goalNear(lab);
  await begin(lab, goal);
  const start = tool(lab);
  // A press steers and sets no other goal, also on the bead.
  const near: Point = [start[0] + (goal[0] - start[0]) / 4, start[1] + (goal[1] - start[1]) / 4];
  await mouse.move(...(await lab.px(near)));
  await mouse.down();
  await until('the hand', () => lab.state.steer_m && distance(lab.state.steer_m, near) < 0.003);
  await mouse.up();
  await lab.stepUntil('the place', () => distance(tool(lab), near) < 0.004);
  await lab.step(SECOND_TICKS);
  expect(distance(tool(lab), near)).toBeLessThan(0.004);
  expect(lab.state.hand_m).toBeNull();
  await mouse.move(...(await lab.px(near)));
  await mouse.down();
  await mouse.move(...(await lab.px(goal)), { steps: 5 });
  await lab.deliver();
  await mouse.up();
});

test('delivers by touch', LONG, async ({ openLab }) => {
  const lab = await openLab({ hasTouch: true, viewport: { width: 820, height: 1180 } });
  await lab.reset();
  const goal = await goalNear(lab);
  await beginAtSpeed(lab, goal);
  const hand = await HANDS.touch(lab);
  await hand.toward(goal);
  await lab.delivered(1);
  await hand.release();
});

test('delivers by arrow keys, and stops when they are released', async ({ lab }) => {
  await lab.reset();
  const goal = await goalNear(lab);
  await begin(lab, goal);
  const hand = await HANDS.keys(lab);
  const start_m = Math.hypot(...toGo(lab, goal));
  /** A quarter of a second at a time: meanwhile the page points further ahead of the tool. */
  const steer = (what: string, probe: () => boolean) =>
    lab.stepUntil(
      what,
      async () => {
        await hand.toward(goal);
        return probe();
      },
      CONTROL_STEP_TICKS,
    );
  await steer('half of the path', () => Math.hypot(...toGo(lab, goal)) < start_m / 2);
  await hand.release();
  await until('the stop', () => distance(must(lab.state.steer_m, 'a hand'), tool(lab)) < 0.002);
  await lab.step(SECOND_TICKS);
  const stopped = tool(lab);
  await lab.step(SECOND_TICKS);
  expect(distance(tool(lab), stopped)).toBeLessThan(0.002);
  await steer('a delivery', () => lab.state.deliveries > 0);
  await hand.release();
});

test('delivers by gamepad', LONG, async ({ lab }) => {
  const { page } = lab;
  const push = await injectGamepad(lab);
  await lab.reset();
  const goal = await goalNear(lab);
  await beginAtSpeed(lab, goal, '1');
  await expect(page.getByTestId('gamepad')).toContainText('stick');
  const toward = (share: number): Point => {
    const [x, y] = toGo(lab, goal);
    const scale = share / Math.max(1e-9, Math.hypot(x, y));
    return [x * scale, y * scale];
  };
  await push(toward(0.15));
  const start = tool(lab);
  await lab.later(60);
  expect(distance(tool(lab), start), 'in the dead zone').toBeLessThan(0.001);
  await until('half of the path', async () => {
    await push(toward(1));
    return distance(tool(lab), start) > distance(start, goal) / 2;
  });
  await push(toward(1), true);
  await rests(lab);
  await until('a delivery', async () => {
    await push(Math.hypot(...toGo(lab, goal)) > 0.004 ? toward(1) : [0, 0]);
    return lab.state.deliveries > 0;
  });
});

for (const [name, take] of Object.entries(HANDS)) {
  test(
    `delivers through the colon by ${name}, along the path that ERRT took`,
    LONG,
    async ({ openLab }) => {
      test.setTimeout(3 * DELIVERY_MS);
      const lab = await openLab(name === 'touch' ? TABLET : {});
      await lab.reset({ speed: '8', map: 'colon' });
      await lab.controller('ERRT');
      const goal = must(lab.freePoints(await lab.bead(), 0.15, 0.25)[0], 'a goal');
      await lab.setGoal(goal);
      await lab.run();
      const path: Point[] = [tool(lab)];
      await until(
        'a delivery',
        () => {
          const at = tool(lab);
          if (distance(at, must(path.at(-1), 'a place')) > 0.004) path.push(at);
          return lab.state.deliveries > 0;
        },
        DELIVERY_MS,
      );
      path.push(goal);
      await lab.pause();
      await beginAtSpeed(lab, goal, '2');
      const hand = await take(lab);
      let next = 0;
      await until(
        'a delivery by hand',
        async () => {
          while (
            next < path.length - 1 &&
            distance(must(path[next], 'a place'), tool(lab)) < AHEAD_M
          )
            next += 1;
          await hand.toward(must(path[next], 'a place'));
          return lab.state.deliveries > 0;
        },
        DELIVERY_MS,
      );
      await hand.release();
      await lab.pause();
      await lab.reset({ map: 'posts' });
    },
  );
}

test('in fog, the page shows nothing that the camera has not seen', async ({ lab }) => {
  const { page } = lab;
  await lab.reset({ map: 'colon' });
  const goal = lab.freePoints(await lab.bead(), 0.06, 0.12)[0];
  await begin(lab, goal);
  await lab.step(SECOND_TICKS);
  await lab.label('What you see').selectOption('seen');
  await page.mouse.move(...(await lab.px(goal)));
  await page.mouse.down();
  await until('the hand', () => lab.state.steer_m);
  await lab.step(2 * SECOND_TICKS);
  await page.mouse.up();
  // The pixels of all cells that the obstacle map does not know have one colour, that of the fog.
  const { cells, columns, rows } = lab.obstacles;
  const { x_min_m, x_max_m, y_min_m, y_max_m } = lab.scene.workspace;
  const marks = [tool(lab), lab.state.bead_tracked_m, goal, must(lab.state.steer_m, 'the hand')];
  const unseen: Point[] = [];
  // A pixel may belong to two cells, so the neighbours count, too.
  const around = [-1, 0, 1].flatMap((row) => [-1, 0, 1].map((column) => row * columns + column));
  cells.forEach((_, cell) => {
    const isUnseen = around.every((step) => (cells[cell + step] ?? 0) === 0);
    const x = x_min_m + (((cell % columns) + 0.5) * (x_max_m - x_min_m)) / columns;
    const y = y_min_m + ((Math.floor(cell / columns) + 0.5) * (y_max_m - y_min_m)) / rows;
    // Goal, tool and the line of the hand are drawn above the fog.
    const isNear = marks.some((mark) => distance(mark, [x, y]) < 0.04);
    // The border of the workspace is drawn.
    const isInside = Math.min(x - x_min_m, x_max_m - x, y - y_min_m, y_max_m - y) > 0.004;
    if (isUnseen && !isNear && isInside) unseen.push([x, y]);
  });
  expect(unseen.length).toBeGreaterThan(500);
  expect(unseen.length).toBeLessThan(cells.length - 500);
  for (const layer of ['Camera field', 'Capture']) await lab.layer(layer, false);
  const colours = await lab.canvas.evaluate((canvas: HTMLCanvasElement, places) => {
    const { pxPerM, originX, originY } = canvas.dataset;
    const ratio = window.devicePixelRatio;
    const { width, height } = canvas;
    const pixels = canvas.getContext('2d')?.getImageData(0, 0, width, height).data;
    const found = new Set<string>();
    for (const [x, y] of places) {
      const column = Math.round((Number(originX) + x * Number(pxPerM)) * ratio);
      const row = Math.round((Number(originY) - y * Number(pxPerM)) * ratio);
      const at = 4 * (row * width + column);
      found.add(String(pixels?.slice(at, at + 4)));
    }
    return [...found];
  }, unseen);
  expect(colours).toHaveLength(1);
  for (const layer of ['Camera field', 'Capture']) await lab.layer(layer, true);
  // The readout tells no walls, and the camera's picture can take the place of the map.
  await lab.label('What you see').selectOption('camera');
  await expect(page.locator('.camera-canvas')).toBeVisible();
  await page.locator('.camera-canvas').click({ position: { x: 200, y: 200 } });
  await until('the hand', () => lab.state.steer_m);
  await lab.controller('Attractor');
  await expect(page.locator('.plan-canvas')).toBeVisible();
  await lab.reset({ map: 'posts' });
});

/** On a busy machine the hand is slow, and a push that is held for three seconds counts as a trigger at rest. */
const FAR_M = 0.003;

test('a gamepad with an unknown layout rests until its cross was pushed on request', async ({
  lab,
}) => {
  const { page } = lab;
  // As Firefox on Linux shows it: axes 2 and 5 are triggers, 6 and 7 the cross.
  await page.evaluate(() => {
    const axes = [0, 0, -1, 0, 0, -1, 0, 0];
    const buttons = Array.from({ length: 11 }, () => ({ pressed: false }));
    const pad = { id: 'Pad', index: 0, mapping: '', axes, buttons };
    Object.assign(window, { pad });
    navigator.getGamepads = () => [pad as unknown as Gamepad];
  });
  const push = (axis: number, value: number) =>
    page.evaluate(
      ([index, to]) => {
        (window as unknown as { pad: { axes: number[] } }).pad.axes[index] = to;
      },
      [axis, value] as const,
    );
  await lab.reset();
  await begin(lab, await goalNear(lab));
  const hint = page.getByTestId('gamepad');
  await expect(hint).toContainText('push the stick or the cross to the right');
  await lab.step(SECOND_TICKS);
  expect(lab.sent.steer).toBeUndefined();
  const [x, y] = tool(lab);
  await push(6, 1);
  await until('the hand to the right', () => lab.state.steer_m && lab.state.steer_m[0] > x + FAR_M);
  await expect(hint).toContainText('up');
  await push(6, 0);
  // Released when it has rested for 200 ms: the page must have looked twice.
  await page.waitForTimeout(200);
  await lab.drawn();
  await lab.drawn();
  await push(7, -1);
  await until('the hand up', () => lab.state.steer_m && lab.state.steer_m[1] > y + FAR_M);
  await push(7, 0);
  await expect(hint).toHaveText('Gamepad: stick or cross; the first button stops the tool.');
});

test('a viewer cannot steer, and a refused message changes nothing', async ({ lab, openLab }) => {
  await lab.reset();
  await begin(lab, await goalNear(lab));
  const viewer = await openLab();
  await viewer.isRole('viewer');
  await expect(viewer.page.getByTestId('steer-how')).toHaveText('Only the operator steers.');
  await viewer.click(lab.freePoints(tool(lab), 0.05, 0.1)[0]);
  await viewer.drawn();
  expect(viewer.sent.steer).toBeUndefined();
  await viewer.page.close();
  await lab.controller('RL');
});
