// The robot client on the page: who is connected, what moves the arm, what was refused; the operator takes the arm back.

import { type Socket, connect } from 'node:net';
import { once } from 'node:events';
import { Lab, expect, test as base } from './fixtures';
import { violations } from './support/axe';
import { Server } from './support/server';
import { until } from './support/wait';

const ROBOT = '127.0.28.110';
const SCRIPT_PORT = 30_003;
const DASHBOARD_PORT = 29_999;

const test = base.extend<{ robotLab: Lab }>({
  robotLab: async ({ page, watch }, use) => {
    const server = await Server.start({ robot: ROBOT });
    watch.allowHost(server.url);
    await use(await Lab.attach(page, server.url));
    await page.goto('about:blank');
    await server.stop();
  },
});

async function client(port: number): Promise<Socket> {
  const socket = connect(port, ROBOT);
  await once(socket, 'connect');
  return socket;
}

test('the page shows a robot client, what it does and what was refused, and takes the arm back', async ({
  robotLab: lab,
}) => {
  await lab.map('open');
  const choice = lab.page.getByRole('radio', { name: 'Robot client' });
  await expect(choice).toHaveCount(0);
  const { controller } = lab.state;

  // A line moves the arm at once: the session runs, at real speed.
  const script = await client(SCRIPT_PORT);
  script.write('speedl([0.02,0,0,0,0,0], 0.5, 60)\n');
  const motion = lab.page.getByTestId('robot-motion');
  await expect(motion).toHaveText('The program a line moves the arm: speedl.');
  await expect(choice).toBeChecked();
  await expect(lab.page.getByRole('list', { name: 'Robot clients' })).toHaveText(
    '127.0.0.1: 1 connection (URScript)',
  );
  expect(lab.state.running).toBe(true);
  expect(await violations(lab.page)).toEqual([]);

  // What is not understood is refused, and named.
  script.write('get_inverse_kin(p[0,0,0,0,0,0])\n');
  const refused = lab.page.getByRole('list', { name: 'Refused commands' });
  await expect(refused).toContainText(
    'a program: line 1: "get_inverse_kin(p[0,0,0,0,0,0])" is not one',
  );

  // At the edge of the workspace the arm stops, until the dashboard frees it.
  script.write('movel(p[0,-0.35,0.05,2.2214,-2.2214,0], a=0.5, v=0.2)\n');
  await expect(motion).toHaveText(/^Protective stop: .*above the table/);
  const stopped = lab.state.tool_m;
  const dashboard = await client(DASHBOARD_PORT);
  dashboard.write('unlock protective stop\n');
  await expect(motion).toHaveText('No program runs: the arm rests.');
  expect(lab.state.tool_m[2]).toBeCloseTo(stopped[2], 4);

  // The operator takes the arm from a program that runs.
  script.write('speedl([-0.02,0,0,0,0,0], 0.5, 60)\n');
  await expect(motion).toHaveText('The program a line moves the arm: speedl.');
  await lab.page.getByRole('radio', { name: 'ERRT' }).check();
  await until('the operator has it', () => lab.state.controller === 'errt');
  await until('no program', () => lab.state.robot?.program === null);
  await expect(choice).toHaveCount(0);
  // The arm goes back to the height of the controllers.
  await until('the height', () => Math.abs(lab.state.tool_m[2] - 0.1) < 1e-4);
  expect(controller).not.toBe('robot');
  script.destroy();
  dashboard.destroy();
});
