// The robot that the arm mirrors: what the page says of it, and the button that lets it follow while it is held.

import type { Locator } from '@playwright/test';
import { DAILY, LONG, Lab, expect, test as base } from './fixtures';
import { violations } from './support/axe';
import { DESKTOP, TABLET } from './support/browser';
import { INPUT_METHODS } from './support/inputMethods';
import { Server } from './support/server';
import { until } from './support/wait';

/** The table in front of the arm, free on the map `open`. */
const GOAL = [0.1, -0.3] as const;
/** A second of the session: a press that the robot has not followed by then has ended. */
const PRESS_TICKS = 125;

type Way = 'mouse' | 'touch' | 'keyboard';

/** Presses the button, waits, and releases it. */
async function hold(lab: Lab, way: Way, button: Locator, whileHeld: () => Promise<void>) {
  if (way === 'keyboard') {
    await button.focus();
    await lab.page.keyboard.down('Space');
    await whileHeld();
    await lab.page.keyboard.up('Space');
    return;
  }
  const box = await lab.boxOf(button);
  const middle = [box.x + box.width / 2, box.y + box.height / 2] as const;
  const input = new INPUT_METHODS[way](lab);
  if (!('drag' in input)) throw new Error(`${way} does not drag`);
  await input.drag(middle, middle, whileHeld);
}

for (const [number, way] of (['mouse', 'touch', 'keyboard'] as const).entries()) {
  const address = `127.0.28.${112 + number}`;
  const test = base.extend<{ robot: Server; twinLab: Lab }>({
    robot: async ({}, use) => {
      const robot = await Server.start({ robot: address });
      await use(robot);
      await robot.stop();
    },
    twinLab: async ({ page, watch, robot }, use) => {
      expect(robot.pid).toBeDefined();
      const server = await Server.start({ drives: address });
      watch.allowHost(server.url);
      await use(await Lab.attach(page, server.url));
      await page.goto('about:blank');
      await server.stop();
    },
  });

  test.describe(`by ${way}`, way === 'mouse' ? DAILY : LONG, () => {
    test.use(way === 'touch' ? TABLET : DESKTOP);

    test(`the robot follows while the button is held by ${way}, and only then`, async ({
      robot,
      twinLab: lab,
    }) => {
      const connection = lab.page.getByTestId('twin-connection');
      const motion = lab.page.getByTestId('twin-motion');
      const button = lab.button('Hold to move the robot');
      await expect(connection).toHaveText(`Robot ${address} (UR5): running, safety: normal.`);
      await expect(motion).toHaveText('The robot rests, or something else moves it.');
      await until('a robot that is connected is shown where it is', () => lab.state.running);
      await lab.map('open');
      await lab.controller('ERRT');
      await lab.run();
      await lab.setGoal(GOAL);
      const rests = lab.state.tool_m;
      await lab.later(50);
      expect(lab.state.tool_m).toEqual(rests);
      expect(await violations(lab.page)).toEqual([]);

      const travel = () =>
        Math.hypot(lab.state.tool_m[0] - rests[0], lab.state.tool_m[1] - rests[1]);
      // A busy machine may be late: then the robot stops, and the operator presses again.
      for (let tries = 0; tries < 10 && travel() < 0.02; tries++) {
        const { tick } = lab.state;
        // The page may miss the states of a short motion, so that it is held is no condition.
        const hasEnded = () =>
          lab.state.twin?.is_held === false && lab.state.tick > tick + PRESS_TICKS;
        await hold(lab, way, button, () =>
          until('it moves or stops', () => travel() > 0.02 || hasEnded()).then(() => undefined),
        );
      }
      expect(travel()).toBeGreaterThan(0.02);
      await until('it no longer follows', () => lab.state.twin?.is_held === false);
      // The stop takes a moment.
      await lab.later(60);
      const stopped = lab.state.tool_m;
      await lab.later(50);
      expect(lab.state.tool_m).toEqual(stopped);

      await robot.end();
      await expect(connection).toContainText('is not connected');
      await expect(button).toBeDisabled();
    });
  });
}
