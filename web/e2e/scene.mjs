// The workspace in space: what the plan can do, the 3-D view can do.

import { check, until } from './harness.mjs';
import { distance } from './lab.mjs';

const OPEN_MS = 30_000;
const TOGGLES = 3;

const canvasOf = (lab) => lab.page.getByLabel('Scene', { exact: true });
const radio = (lab, name) => lab.page.getByRole('radio', { name, exact: true });

async function numbers(lab, name) {
  const text = await canvasOf(lab).getAttribute(`data-${name}`);
  return text ? text.split(',').map(Number) : undefined;
}

async function open(lab) {
  await radio(lab, '3-D').check();
  await until('a picture', () => numbers(lab, 'bead-px'), OPEN_MS);
}

/** Waits until the picture shows what the server has told last. */
async function settled(lab) {
  let [before, times] = [undefined, 0];
  await until('a picture that stands still', async () => {
    await lab.drawn();
    const now = await canvasOf(lab).getAttribute('data-frames');
    times = now === before ? times + 1 : 0;
    before = now;
    return times === 3;
  });
}

/** Position on the page, in CSS pixels, of a point of the table. */
export async function px(lab, [x, y]) {
  const m = await numbers(lab, 'px-from-table');
  const row = (i) => m[3 * i] * x + m[3 * i + 1] * y + m[3 * i + 2];
  const box = await canvasOf(lab).boundingBox();
  return [box.x + row(0) / row(2), box.y + row(1) / row(2)];
}

async function beadPx(lab) {
  const box = await canvasOf(lab).boundingBox();
  const [x, y] = await numbers(lab, 'bead-px');
  return [box.x + x, box.y + y];
}

/** A free point toward which a hand can go without leaving the picture. */
export async function freeInPicture(lab, least_m, most_m) {
  const box = await canvasOf(lab).boundingBox();
  for (const point of lab.freePoints(lab.state.bead_m, least_m, most_m)) {
    const [x, y] = await px(lab, point);
    // Below the buttons that lie on the picture.
    const isInside = x > box.x + 20 && x < box.x + box.width - 20 && y > box.y + 60;
    if (isInside && y < box.y + box.height - 20) return point;
  }
  throw new Error('no free point in the picture');
}

export async function placesAGoalInSpace({ lab }) {
  await lab.reset();
  await open(lab);
  check(!(await lab.canvas.isVisible()), 'the plan is still there');
  const goal = await freeInPicture(lab, 0.1, 0.25);
  await lab.page.mouse.click(...(await px(lab, goal)));
  const set = await until('a goal', () => lab.state.goal_m);
  check(distance(set, goal) < 0.002, `the goal is at ${set}, not at ${goal}`);
  await lab.run();
  await until('a carried bead', () => lab.state.phase === 'transporting');
  await lab.pause();
}

export async function disturbsInSpace({ lab }) {
  await lab.reset();
  await open(lab);
  const { mouse } = lab.page;
  await settled(lab);
  const camera = await canvasOf(lab).getAttribute('data-px-from-table');
  const away = await freeInPicture(lab, 0.06, 0.12);
  const bead = lab.state.bead_m;
  await lab.run();
  await mouse.move(...(await beadPx(lab)));
  await until(
    'the bead offers itself',
    async () => (await canvasOf(lab).getAttribute('data-cursor')) === 'near-bead',
  );
  await mouse.down();
  await mouse.move(...(await px(lab, away)), { steps: 10 });
  await until('the hand there', () => lab.state.hand_m && distance(lab.state.hand_m, away) < 0.003);
  await until('the bead at the hand', () => distance(lab.state.bead_m, away) < 0.01);
  check(distance(lab.state.bead_m, bead) > 0.03, 'the bead did not move');
  check(/\d N · |mN · /.test(await lab.page.locator('.spring-label').innerText()), 'no force');
  await lab.screenshot('scene-dragging');
  await mouse.up();
  await until('no hand', () => !lab.state.hand_m);
  check(
    (await canvasOf(lab).getAttribute('data-px-from-table')) === camera,
    'dragging the bead turned the view',
  );
  check(!lab.state.goal_m, 'dragging the bead placed a goal');
  await lab.pause();
}

export async function turnsTheScene({ lab }) {
  await lab.reset();
  await open(lab);
  await settled(lab);
  const { mouse, keyboard } = lab.page;
  const canvas = canvasOf(lab);
  const look = () => canvas.screenshot();
  const home = await numbers(lab, 'px-from-table');
  const picture = await look();
  const box = await canvas.boundingBox();
  const corner = [box.x + 40, box.y + box.height - 30];
  await mouse.move(...corner);
  await mouse.down();
  await mouse.move(corner[0] + 120, corner[1] - 30, { steps: 6 });
  await mouse.up();
  const turned = await numbers(lab, 'px-from-table');
  const differ = (a, b) => Math.max(...a.map((n, i) => Math.abs(n - b[i])));
  check(differ(turned, home) > 10, 'the view did not turn');
  await until('another picture', async () => !(await look()).equals(picture));
  check(!lab.state.goal_m, 'turning the view placed a goal');
  await mouse.wheel(0, -240);
  await until(
    'a nearer view',
    async () => differ(await numbers(lab, 'px-from-table'), turned) > 10,
  );
  for (const name of ['Top', 'Front', 'Side']) {
    const before = await canvas.getAttribute('data-px-from-table');
    await lab.button(name).click();
    check((await canvas.getAttribute('data-px-from-table')) !== before, `${name} shows the same`);
  }
  await canvas.focus();
  await keyboard.press('Home');
  const back = await numbers(lab, 'px-from-table');
  check(differ(back, home) < 1e-3, 'Home is elsewhere');
}

export async function showsTheFieldInSpace({ lab }) {
  await lab.reset();
  await open(lab);
  await settled(lab);
  const look = () => canvasOf(lab).screenshot();
  const bare = await look();
  await lab.layer('Field and pull');
  await until('a picture with it', async () => !(await look()).equals(bare));
  await settled(lab);
  await lab.screenshot('scene-field');
  await lab.layer('Field and pull', false);
  await until('a picture without it', async () => (await look()).equals(bare));
}

export async function obeysTheKeyboardInSpace({ lab }) {
  await lab.reset();
  await open(lab);
  await canvasOf(lab).focus();
  const { keyboard } = lab.page;
  await keyboard.press('Home');
  const bead = lab.state.bead_m;
  const aim = lab.freePoints(bead, 0.04, 0.12)[0];
  for (const [delta, back, forth] of [
    [aim[0] - bead[0], 'ArrowLeft', 'ArrowRight'],
    [aim[1] - bead[1], 'ArrowDown', 'ArrowUp'],
  ]) {
    const presses = Math.max(1, Math.round(Math.abs(delta) / 0.005));
    for (let i = 0; i < presses; i++) await keyboard.press(delta < 0 ? back : forth);
  }
  await keyboard.press('Enter');
  const goal = await until('a goal', () => lab.state.goal_m);
  check(distance(goal, aim) < 0.01, `the goal is at ${goal}, not at ${aim}`);
  await keyboard.press(' ');
  await until('running', () => lab.state.running);
  await keyboard.press('d');
  const held = await until('the hand', () => lab.state.hand_m);
  // The hand stays where it is on the table while the view turns under it.
  await keyboard.press(']');
  await keyboard.press('ArrowRight');
  await until(
    'a hand that follows',
    () => lab.state.hand_m && distance(lab.state.hand_m, held) > 0,
  );
  check(distance(lab.state.hand_m, held) < 0.008, 'turning the view flung the hand away');
  await keyboard.press('Escape');
  await until('no hand', () => !lab.state.hand_m);
  await keyboard.press(' ');
  await until('paused', () => !lab.state.running);
  await keyboard.press('Home');
}

export async function frees({ lab, watch }) {
  const held = async () => {
    await settled(lab);
    return [await numbers(lab, 'geometries'), await numbers(lab, 'textures')].flat();
  };
  // What a reset leaves of the hand and the trails may go a frame later: fewer things are no leak.
  const grew = (now, before) => now.some((count, i) => count > before[i]);
  await lab.reset();
  await open(lab);
  const first = await held();
  await lab.reset({ map: 'colon' });
  await settled(lab);
  await lab.screenshot('scene-dark');
  await lab.button('Use light colours').click();
  await settled(lab);
  await lab.screenshot('scene-light');
  await lab.button('Use dark colours').click();
  await lab.reset();
  await until(`no more than ${first} on the card`, async () => !grew(await held(), first));

  const complaints = watch.complaints.length;
  for (let i = 0; i < TOGGLES; i++) {
    // A browser keeps a few contexts only, and frees one late that is merely forgotten.
    const old = await canvasOf(lab).elementHandle();
    await radio(lab, 'Plan').check();
    const isLost = () => old.evaluate((canvas) => canvas.getContext('webgl2').isContextLost());
    await until('the context to go', isLost);
    await open(lab);
  }
  await until(`${first} again`, async () => !grew(await held(), first));
  check(watch.complaints.length === complaints, `it says: ${watch.complaints.slice(complaints)}`);
}

export async function goesBackToThePlan({ lab }) {
  await open(lab);
  await lab.page.reload();
  await until('the remembered view', () => canvasOf(lab).isVisible());
  await until('live', async () => (await lab.text('connection')) === 'live');
  await until('the operator', async () => (await lab.text('role')) === 'operator');
  await radio(lab, '3-D').focus();
  await lab.page.keyboard.press('ArrowLeft');
  await lab.canvas.waitFor();
  check((await canvasOf(lab).count()) === 0, 'the scene is still there');
  await lab.reset();
  const goal = lab.freePoints(await lab.point('bead'), 0.1, 0.2)[0];
  await lab.click(goal);
  await until('a goal', () => lab.state.goal_m);
}

export async function saysWhatIsMissing({ lab }) {
  await radio(lab, 'Plan').check();
  // As in a browser that has no 3-D, or where it is switched off.
  const restore = await lab.page.evaluateHandle(() => {
    const { prototype } = document.createElement('canvas').constructor;
    const { getContext } = prototype;
    prototype.getContext = function (kind, ...rest) {
      return kind === 'webgl2' ? null : getContext.call(this, kind, ...rest);
    };
    return () => {
      prototype.getContext = getContext;
    };
  });
  await radio(lab, '3-D').check();
  await lab.page.getByText('it has no WebGL 2').waitFor({ timeout: OPEN_MS });
  await lab.screenshot('scene-missing');
  await lab.button('Back to the plan').click();
  await lab.canvas.waitFor();
  check(await radio(lab, 'Plan').isChecked(), 'the switch says something else');
  await restore.evaluate((undo) => undo());
}
