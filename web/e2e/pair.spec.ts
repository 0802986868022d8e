// Operator and viewer at one session: control passes between them, and what the viewer sees.

import { Lab, expect, test } from './fixtures';
import { distance } from './support/table';
import { until } from './support/wait';

const CONTROL_REQUESTED = /asks for control/i;

const freePointNearBead = async (lab: Lab) => lab.freePoints(await lab.bead(), 0.1, 0.3)[0];

test('shows a viewer what the operator does', async ({ lab, openLab }) => {
  const viewer = await openLab();
  await viewer.isRole('viewer');
  const before = viewer.state;
  const received = viewer.events.length;
  await lab.click(await freePointNearBead(lab));
  await lab.run();
  await until('the goal', () => viewer.state.goal_m);
  await until('a moving bead', () => distance(viewer.state.bead_m, before.bead_m) > 0.01);
  await expect(viewer.page.getByTestId('sim-time')).not.toHaveAttribute(
    'title',
    `Tick ${before.tick}`,
  );
  expect(viewer.events.length).toBeGreaterThan(received);
  await viewer.panel('Story');
  await expect(viewer.page.getByRole('log').getByText('goal placed').first()).toBeVisible();
  await expect(viewer.page.getByText('Another browser steers.')).toBeVisible();
  await expect(viewer.button('Pause')).toHaveCount(0);
  await lab.button('Pause').click();
  await until('paused', () => !viewer.state.running);
});

test('passes released control to the viewer that requested it', async ({ lab, openLab }) => {
  const viewer = await openLab();
  await viewer.isRole('viewer');
  // A request is granted when the operator releases control.
  await viewer.button('Take control').click();
  await expect(viewer.page.getByText(/It is yours in \d+ s/)).toBeVisible();
  const give = lab.button('Give control');
  await give.waitFor();
  await lab.panel('Story');
  await expect(lab.page.getByRole('log').getByText(CONTROL_REQUESTED).first()).toBeVisible();
  await lab.isRole('operator');
  await give.click();
  await viewer.isRole('operator');
  await expect(viewer.button('Run')).toBeEnabled();
  await expect(lab.button('Run')).toHaveCount(0);

  // The other one keeps it at first, and releases it later.
  await lab.button('Take control').click();
  await viewer.button('Keep').click();
  await expect(viewer.button('Give control')).toHaveCount(0);
  await expect(lab.notice('session')).toContainText('You can ask again in a minute.');
  await lab.button('Take control').click();
  await expect(lab.notice('session')).toContainText(/ask again in \d+ s/i);
  await viewer.isRole('operator');
  await viewer.releaseControl();
  await lab.takeControl();

  // A viewer can take free control.
  await lab.releaseControl();
  await lab.takeControl();
});

test('a viewer opens a session of its own with one press', async ({ lab, openLab, server }) => {
  const viewer = await openLab();
  await viewer.isRole('viewer');
  await viewer.page.getByRole('button', { name: 'Open your own' }).click();
  await viewer.isRole('operator');
  await until('its own session', () => viewer.hello.session !== lab.hello.session);
  await lab.isRole('operator');
  await fetch(`${server.url}/api/sessions/${viewer.hello.session}`, { method: 'DELETE' });
});

test('a first visitor acts after one press though another steers', async ({
  lab,
  session,
  browser,
  server,
}) => {
  await lab.isRole('operator');
  const context = await browser.newContext();
  const page = await context.newPage();
  const visitor = new Lab(page);
  await page.goto(session.url);
  await expect(page.getByText('Another browser steers this one')).toBeVisible();
  await visitor.button('Pull it away').click();
  await visitor.live();
  await visitor.isRole('operator');
  await until('its own session that runs', () => visitor.state.running);
  expect(visitor.hello.session).not.toBe(lab.hello.session);
  await lab.isRole('operator');
  await context.close();
  await fetch(`${server.url}/api/sessions/${visitor.hello.session}`, { method: 'DELETE' });
});

test('says beside the button that the server is full', async ({ lab, openLab, server, watch }) => {
  watch.allow(/Failed to load resource/);
  await lab.isRole('operator');
  const made: string[] = [];
  for (;;) {
    const answer = await fetch(`${server.url}/api/sessions`, { method: 'POST' });
    if (answer.status !== 201) break;
    made.push(((await answer.json()) as { id: string }).id);
  }
  const viewer = await openLab();
  await viewer.isRole('viewer');
  await viewer.button('Open your own').click();
  await expect(viewer.page.getByRole('alert').getByText(/the server is full/i)).toBeVisible();
  await expect(viewer.button('Open your own')).toBeEnabled();
  for (const id of made) await fetch(`${server.url}/api/sessions/${id}`, { method: 'DELETE' });
});

test('a page that is loaded again keeps control though another asks', async ({ lab, openLab }) => {
  const viewer = await openLab();
  await viewer.isRole('viewer');
  await viewer.button('Take control').click();
  await lab.button('Give control').waitFor();
  await lab.page.reload();
  await lab.live();
  await lab.isRole('operator');
  await lab.button('Keep').click();
  await viewer.isRole('viewer');
});

test('releases the bead when the operator closes the browser', async ({ lab, openLab }) => {
  await lab.releaseControl();
  const other = await openLab();
  await other.isRole('operator');
  await other.reset();
  await other.startDrag(other.freePoints(await other.bead(), 0.05, 0.1)[0]);
  await until("the hand on the viewer's page", () => lab.state.hand_m);
  await other.page.context().close();
  await until('no hand', () => !lab.state.hand_m);
  await lab.takeControl();
});
