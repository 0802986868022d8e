// What is particular to each of the controllers: ERRT's plan, the attractor's flow.

import { check, until } from './harness.mjs';

async function select(lab, name) {
  await lab.page.getByRole('radio', { name, exact: true }).check();
  await until(name, () => lab.state.controller === name.toLowerCase());
}

/** Whether showing a layer changes any of a few places, and hiding it changes them back. */
async function shows(lab, layer, points) {
  const look = async () => {
    const looks = [];
    for (const point of points) looks.push(await lab.look(point));
    return looks.join(' ');
  };
  await lab.layer(layer, false);
  const bare = await look();
  await lab.layer(layer);
  await until(`the layer ${layer}`, async () => (await look()) !== bare);
  await lab.layer(layer, false);
  await until(`no layer ${layer}`, async () => (await look()) === bare);
  await lab.layer(layer);
}

export async function carriesAlongAWay({ lab }) {
  await lab.reset({ map: 'colon', speed: '8' });
  await select(lab, 'ERRT');
  const bead = await lab.point('bead');
  const goal = lab.freePoints(bead, 0.25, 0.4).at(-1);
  await lab.click(goal);
  await until('a goal', () => lab.point('goal'));
  await lab.run();
  await until('a plan', async () => (await lab.number('plan-plans')) >= 1);
  await until('a way', async () => (await lab.text('plan-way')).endsWith('cm'));
  await until('a little of the way', () => lab.overlay?.plan?.way.length > 1);
  await lab.button('Pause').click();
  await until('paused', () => !lab.state.running);

  const { way, obstacles } = lab.overlay.plan;
  const corners = way.map(([x, y]) => [x, y]);
  await shows(lab, 'Plan', corners);
  const largest = obstacles
    .map(({ x_min_m, x_max_m, y_min_m, y_max_m }) => ({
      at: [x_max_m, (y_min_m + y_max_m) / 2],
      area: (x_max_m - x_min_m) * (y_max_m - y_min_m),
    }))
    .sort((a, b) => b.area - a.area)
    .slice(0, 8);
  await shows(
    lab,
    'Obstacles',
    largest.map(({ at }) => at),
  );
  await lab.screenshot('plan');
  await lab.layer('Obstacles', false);
  await lab.run();
  await lab.delivered(1);
  await lab.button('Pause').click();
  await select(lab, 'Attractor');
  await until('no plan', async () => (await lab.page.getByTestId('plan-plans').count()) === 0);
}

export async function showsWhereTheAttractorLeads({ lab }) {
  await lab.reset({ map: 'posts' });
  await select(lab, 'Attractor');
  const legend = lab.page.getByRole('group', { name: 'Arrows and dots' });
  await lab.layer('Attractor flow');
  const words = async () => (await legend.textContent()).replaceAll(/\s+/g, ' ');
  check((await words()).includes('Place a goal'), `without a goal: ${await words()}`);
  await lab.click(lab.freePoints(await lab.point('bead'), 0.3, 0.5)[0]);
  await until('the flow', async () => /\d|none/.test(await lab.text('flow-traps')));
  check((await words()).includes('where the attractor leads'), `with a goal: ${await words()}`);

  // A place of the grid: an arrow goes through it, unless it is over a wall.
  const { x_min_m, x_max_m, y_min_m, y_max_m } = lab.scene.workspace;
  const spacing_m = Math.max(x_max_m - x_min_m, y_max_m - y_min_m) / 40;
  const across = Math.floor((y_max_m - y_min_m) / spacing_m + 1e-9);
  const margin_m = (y_max_m - y_min_m - across * spacing_m) / 2;
  const places = [8, 20, 32].map((column) => [
    x_min_m + column * spacing_m,
    y_min_m + margin_m + 11 * spacing_m,
  ]);
  await shows(lab, 'Attractor flow', places);
  await lab.screenshot('flow');

  // A click beside the menu closes it, and places no goal.
  const goal = await lab.point('goal');
  await lab.button('Layers').click();
  // On the left, where the menu covers nothing.
  await lab.click(lab.freePoints(goal, 0.1, 0.6).find(([x]) => x < x_min_m + 0.1));
  const menu = lab.page.getByRole('group', { name: 'Layers' });
  await menu.waitFor({ state: 'detached' });
  await lab.page.waitForTimeout(200);
  check(String(await lab.point('goal')) === String(goal), 'the click placed a goal');
  await lab.layer('Attractor flow', false);
  await legend.waitFor({ state: 'detached' });
}
