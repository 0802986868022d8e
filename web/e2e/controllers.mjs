// What is particular to each of the controllers: the policy's quantiles, ERRT's plan, the attractor's flow.

import { check, until } from './harness.mjs';

/** The server looks at a map from every free centimetre before it first tells values. */
const FIRST_LOOK_MS = 60_000;

/** A number of the page with its true minus sign. */
async function signed(lab, testid) {
  return Number((await lab.text(testid)).replace('−', '-'));
}

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

export async function decidesByQuantiles({ lab }) {
  const { page } = lab;
  await lab.reset({ map: 'colon' });
  await select(lab, 'RL');
  const questions = [];
  page.on('request', (request) => {
    if (request.url().endsWith('/values')) questions.push(request.postData());
  });

  // The legend is as high without values as with them: the map does not move under the points.
  const legend = page.getByRole('group', { name: 'Values' });
  await lab.layer('Value');
  await until('a wish', async () => (await legend.textContent()).includes('Place a goal'));
  const bead = await lab.point('bead');
  const goal = lab.freePoints(bead, 0.25, 0.4).at(-1);
  const places = lab.freePoints(bead, 0.06, 0.2).slice(0, 5);
  const look = async () => {
    const looks = [];
    for (const place of places) looks.push(await lab.look(place));
    return looks.join(' ');
  };
  const bare = await until('a picture that stands still', async () => {
    const first = await look();
    return first === (await look()) && first;
  });
  await lab.click(goal);
  const least = page.getByTestId('value-least');
  await until('values', async () => (await least.count()) === 1, FIRST_LOOK_MS);
  const range = [await signed(lab, 'value-least'), await signed(lab, 'value-greatest')];
  check(range[0] < range[1], `the legend says ${range}`);
  await until('the layer Value', async () => (await look()) !== bare);

  await lab.run();
  await until('a judgement', () => lab.overlay?.judgement);
  await lab.pause();
  const names = ['plus-x', 'minus-x', 'plus-y', 'minus-y'];
  const shown = () => Promise.all(names.map((name) => signed(lab, `rl-value-${name}`)));
  // What is shown may be a frame behind what came.
  const values = await until('the values that came', async () => {
    const came = lab.overlay;
    const now = await shown();
    const isSame = (value, index) => Math.abs(value - came.judgement.values[index]) < 0.001;
    return came === lab.overlay && now.every(isSame) && now;
  });
  check(values.every(Number.isFinite), `the fans say ${values}`);
  const { taken, trained_on } = lab.overlay.judgement;
  const best = values.indexOf(Math.max(...values));
  const words = await page.getByText('Taken:').innerText();
  check(words.includes(['+x', '−x', '+y', '−y'][taken]), `the panel says ${words}`);
  check((best !== taken) === words.includes('next best'), `${values}, but ${words}`);
  check((await lab.text('rl-trained-on')) === trained_on.join(', '), 'trained on something else');
  check(
    (await page.getByTestId('rl-unseen').count()) === 0,
    'it says that it does not know the colon',
  );
  await lab.screenshot('quantiles');

  const parameters = () => lab.scene.parameters;
  await page.getByLabel('Shield', { exact: true }).uncheck();
  await until('no shield', () => parameters().rl_shield === false);
  check(questions.length === 1, `asked ${questions.length} times for one goal`);
  await page.getByLabel('Policy', { exact: true }).selectOption('Colon');
  await until('the policy', () => parameters().rl_policy === 'colon');
  await until('values by that policy', () => questions.length === 2);
  await lab.button('Restore defaults').click();
  await until('the defaults', () => parameters().rl_shield && parameters().rl_policy === 'auto');

  await lab.speed('8');
  await lab.run();
  await lab.delivered(1);
  await lab.pause();
  await lab.layer('Value', false);
  await legend.waitFor({ state: 'detached' });
  await select(lab, 'Attractor');
  await until('no fans', async () => (await page.getByTestId('rl-taken').count()) === 0);
}

export async function saysWhatThePolicyHasNotSeen({ lab }) {
  await lab.reset({ map: 'attractor-example-arm' });
  await select(lab, 'RL');
  await lab.click(lab.freePoints(await lab.point('bead'), 0.06, 0.2)[0]);
  await lab.run();
  await lab.page.getByTestId('rl-unseen').waitFor();
  await lab.pause();
  check(!lab.overlay.judgement.trained_on.includes(lab.scene.map), 'it has seen the map');
  await select(lab, 'Attractor');
}

export async function carriesAlongAWay({ lab }) {
  await lab.reset({ map: 'colon' });
  await select(lab, 'ERRT');
  const bead = await lab.point('bead');
  const goal = lab.freePoints(bead, 0.25, 0.4).at(-1);
  await lab.click(goal);
  await until('a goal', () => lab.point('goal'));
  await lab.run();
  await until('a plan', async () => (await lab.number('plan-plans')) >= 1);
  await until('a way', async () => (await lab.text('plan-way')).endsWith('cm'));
  await until('a little of the way', () => lab.overlay?.plan?.way.length > 1);
  await lab.pause();

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
  await lab.speed('8');
  await lab.run();
  await lab.delivered(1);
  await lab.pause();
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
