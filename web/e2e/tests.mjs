// What a person does with the dashboard, on a real server.

import { BUDGET } from './budget.mjs';
import { check, until } from './harness.mjs';
import {
  carriesAlongAWay,
  decidesByQuantiles,
  saysWhatThePolicyHasNotSeen,
  showsWhereTheAttractorLeads,
} from './controllers.mjs';
import {
  followsAFinger,
  letsGoByItself,
  letsGoWhenTheSocketIsLost,
  placesTheBeadWhilePaused,
  showsThatTheBeadCanBeTaken,
} from './gestures.mjs';
import {
  bendsTheCurvesBesideThem,
  disturbsByScript,
  keepsTime,
  obeysKeysAllOver,
  plotsThePapersFigure,
  saysWhatHappens,
} from './instruments.mjs';
import {
  aViewerMayPredict,
  everyLessonShowsWhatItClaims,
  learnsByKeyboard,
  loadsAPreset,
  refusesABrokenLink,
  sharesAnExperiment,
} from './lessons.mjs';
import { cancelsAnEvaluation, evaluates, setsAFailureUpAgain } from './evaluate.mjs';
import { HOLDS } from './holds.mjs';
import { Lab, distance, distanceToSegment } from './lab.mjs';
import { LOGIN } from './login.mjs';
import { MAPS } from './maps.mjs';
import { PAIR } from './pair.mjs';
import { comparesControllers, keepsADragAsACase, tellsWhy } from './past.mjs';
import { listsRecordings, opensARecording } from './recordings.mjs';
import {
  disturbsInSpace,
  frees,
  goesBackToThePlan,
  obeysTheKeyboardInSpace,
  placesAGoalInSpace,
  saysWhatIsMissing,
  turnsTheScene,
  showsTheFieldInSpace,
} from './scene.mjs';
import { PROOF } from './proof.mjs';
import { SESSIONS } from './sessions.mjs';

/** Comfortably more than the default threshold of the switching law. */
const LOST_M = 0.14;

/** Starts to note every text that the mode badge shows. */
function watchMode(lab) {
  return lab.page.evaluateHandle(() => {
    const badge = document.querySelector('[data-testid=mode]');
    const seen = [badge.textContent];
    new MutationObserver(() => seen.push(badge.textContent)).observe(badge, {
      characterData: true,
      childList: true,
      subtree: true,
    });
    return seen;
  });
}

async function opens({ lab }) {
  check((await lab.text('role')) === 'operator', 'the first browser is not the operator');
  check(await lab.button('Run').isVisible(), 'the session is not paused');
  const safety = lab.page.getByText('simulation, not safety-rated');
  check(await safety.isVisible(), 'no word about safety');
  const unnamed = await lab.page.locator('button, input, select, canvas').evaluateAll((all) =>
    all
      .filter(
        (one) =>
          !one.getAttribute('aria-label') &&
          !one.labels?.[0]?.textContent.trim() &&
          !one.textContent.trim() &&
          // A plot is one picture; what it is made of has no name.
          !one.closest('[role=img]'),
      )
      .map((one) => one.outerHTML),
  );
  check(unnamed.length === 0, `without an accessible name: ${unnamed.join(' ')}`);
}

async function deliversToAClick({ lab }) {
  await lab.reset({ speed: '4' });
  const bead = await lab.point('bead');
  const [goal] = lab.freePoints(bead, 0.2, 0.3);
  await lab.click(goal);
  await until('a goal', () => lab.point('goal'));
  check(distance(await lab.point('goal'), goal) < 0.002, 'the goal is not where the click was');
  await lab.run();
  await lab.delivered(1);
  await lab.screenshot('delivered');
}

async function recoversFromADisturbance({ lab }) {
  const before = { disturbances: await lab.number('disturbances') };
  const [goal] = lab.freePoints(await lab.point('bead'), 0.3, 0.5);
  await lab.speed('1');
  await lab.click(goal);
  await until('transport', async () => (await lab.text('phase')) === 'transporting');
  const modes = await watchMode(lab);
  // While time stands the bead does not leave the pointer, however slow this machine is.
  const { mouse, keyboard } = lab.page;
  await keyboard.press(' ');
  await until('a pause', () => !lab.state.running);

  const bead = await lab.point('bead');
  // Off the way to the goal: a bead dragged along it on a slow machine would never be lost.
  const away = lab
    .freePoints(bead, 0.15, 0.3)
    .find((point) => distanceToSegment(point, bead, goal) > LOST_M);
  check(away, 'no free point off the way');
  await mouse.move(...(await lab.px(bead)));
  await mouse.down();
  await mouse.move(...(await lab.px(away)), { steps: 12 });
  await until('the hand', () => lab.state.hand_m);
  await keyboard.press(' ');
  await until('the bead at the hand', async () => distance(await lab.point('bead'), away) < 0.01);
  await lab.screenshot('dragging');
  await mouse.up();

  await until('both switches', async () => (await modes.jsonValue()).join('').includes('212'));
  await lab.speed('4');
  await lab.delivered(2);
  const seen = (await modes.jsonValue()).join('');
  check(seen.includes('212'), `the mode went ${seen}`);
  check(
    (await lab.number('disturbances')) > before.disturbances,
    'the disturbance was not counted',
  );
}

async function refusesAGoalInAWall({ lab }) {
  const goal = await lab.point('goal');
  await lab.click(lab.wallPoint());
  await lab.notice('workspace').waitFor();
  check(String(await lab.point('goal')) === String(goal), 'the goal changed');
  await lab.screenshot('goal-in-wall');
}

async function obeysTheKeyboard({ lab }) {
  await lab.reset();
  await lab.canvas.focus();
  const { keyboard } = lab.page;
  const bead = await lab.point('bead');
  const aim = lab.freePoints(bead, 0.04, 0.12)[0];
  for (const [delta, back, forth] of [
    [aim[0] - bead[0], 'ArrowLeft', 'ArrowRight'],
    [aim[1] - bead[1], 'ArrowDown', 'ArrowUp'],
  ]) {
    const presses = Math.max(1, Math.round(Math.abs(delta) / 0.005));
    for (let i = 0; i < presses; i++) await keyboard.press(delta < 0 ? back : forth);
  }
  await keyboard.press('Enter');
  const goal = await until('a goal', () => lab.point('goal'));
  check(distance(goal, aim) < 0.01, `the goal is at ${goal}, not at ${aim}`);

  await keyboard.press(' ');
  await until('running', () => lab.state.running);
  // A key that is held takes once.
  await keyboard.down('d');
  await until('the hand', () => lab.state.hand_m);
  for (let i = 0; i < 3; i++) await keyboard.down('d');
  await keyboard.up('d');
  await lab.page.waitForTimeout(300);
  check(lab.state.hand_m, 'the held key let go');
  await keyboard.press('Escape');
  await until('no hand', () => !lab.state.hand_m);
  await keyboard.press(' ');
  await until('paused', () => !lab.state.running);
}

async function bindsParametersBothWays({ lab }) {
  const threshold = lab.page.getByRole('spinbutton', { name: 'Threshold T' });
  await threshold.fill('8');
  await threshold.press('Enter');
  await until('T = 8 cm', () => lab.scene.parameters.threshold_m === 0.08);
  // A slider that goes back to where it was leaves nothing behind.
  const slider = lab.page.getByRole('slider', { name: 'Threshold T slider' });
  const box = await slider.boundingBox();
  const { min, max } = await slider.evaluate(({ min, max }) => ({ min, max }));
  const at = box.x + 8 + ((8 - min) / (max - min)) * (box.width - 16);
  const y = box.y + box.height / 2;
  await lab.page.mouse.move(at, y);
  await lab.page.mouse.down();
  await lab.page.mouse.move(at + 40, y, { steps: 4 });
  await until('it moves', async () => (await threshold.inputValue()) !== '8.0');
  await lab.page.mouse.move(at, y, { steps: 4 });
  await lab.page.mouse.up();
  await until('it is back', async () => (await threshold.inputValue()) === '8.0');
  await lab.button('Restore defaults').click();
  await until(
    'defaults',
    () => lab.scene.parameters.threshold_m === lab.scene.defaults.threshold_m,
  );
  await until('the form', async () => (await threshold.inputValue()) === '10.0');
}

/** In words, once the server has answered. */
function captureWords(lab) {
  return until('a capture', async () => {
    const text = await lab.text('magnet-capture');
    return text !== '–' && text;
  });
}

async function showsWhatTheMagnetCan({ lab }) {
  await lab.reset();
  const { mouse } = lab.page;
  await lab.page.getByRole('tab', { name: 'Magnet' }).click();
  await lab.page.getByText('Magnet and bead').click();
  const before = await captureWords(lab);
  check(before === '4 to 95 mm', `at the defaults it captures ${before}`);
  const hidden = await lab.page
    .locator('.magnet-words')
    .evaluate((words) => words.scrollHeight - words.clientHeight);
  check(hidden <= 0, `${hidden} px of the words beside the curves are hidden`);

  const slider = lab.page.getByRole('slider', { name: 'Friction μ slider' });
  await slider.scrollIntoViewIfNeeded();
  const box = await slider.boundingBox();
  const y = box.y + box.height / 2;
  // The slider reaches from 0 to 1.
  await mouse.move(box.x + 0.2 * box.width, y);
  await mouse.down();
  await mouse.move(box.x + 0.4 * box.width, y, { steps: 5 });
  await until('less captured', async () => (await captureWords(lab)) !== before);
  check(lab.scene.parameters.friction === 0.2, 'the slider was sent before it was let go');
  await mouse.up();
  await until('the friction', () => lab.scene.parameters.friction > 0.3);
  check((await captureWords(lab)) !== before, 'the panel forgot the friction');
  await lab.screenshot('magnet');

  await lab.button('Restore defaults').click();
  await until('the defaults', async () => (await captureWords(lab)) === before);
  await lab.page.getByText('Magnet and bead').click();
  await lab.page.getByRole('tab', { name: 'Plots' }).click();
}

async function showsSingularities({ lab }) {
  await lab.reset();
  // Far from everything that moves, and off the grid.
  const [x, y] = lab.freePoints(await lab.point('bead'), 0.3, 0.5)[0];
  const look = () => lab.look([x + 0.007, y + 0.007]);
  const bare = await look();
  await lab.layer('Singularity');
  await until('the layer', async () => (await look()) !== bare);
  const range = [await lab.number('heat-least'), await lab.number('heat-greatest')];
  check(range[0] >= 2 && range[0] < range[1], `the legend says ${range}`);
  await lab.screenshot('singularity');
  await lab.layer('Singularity', false);
  await until('the bare floor', async () => (await look()) === bare);
}

async function showsTheField({ lab }) {
  await lab.reset();
  // Between the arrows, some centimetres beside the tool.
  const [x, y] = await lab.point('bead');
  const look = () => lab.look([x + 0.04, y - 0.005]);
  const bare = await look();
  await lab.layer('Field and pull');
  await until('the layer', async () => (await look()) !== bare);
  // The dipole of the block at 10 cm; specification §2 has its pull.
  const field_mt = await lab.number('field-greatest');
  check(field_mt > 1.5 && field_mt < 4, `|B| is ${field_mt} mT`);
  const pull_mn = await lab.number('field-pull');
  check(pull_mn > 1 && pull_mn < 3, `the pull is ${pull_mn} mN`);
  await lab.screenshot('field');
  await tuneHeight(lab, '150');
  await until('less of it', async () => (await lab.number('field-greatest')) < 0.5 * field_mt);
  await lab.button('Restore defaults').click();
  await until('as before', async () => (await lab.number('field-greatest')) === field_mt);
  await lab.layer('Field and pull', false);
  await until('the bare floor', async () => (await look()) === bare);
}

async function tuneHeight(lab, value_mm) {
  const group = lab.page.locator('summary').filter({ hasText: /^Magnet and bead/ });
  await group.click();
  const height = lab.page.getByRole('spinbutton', { name: 'Tool height' });
  await height.fill(value_mm);
  await height.press('Enter');
  await group.click();
}

async function showsWhatTheCameraTells({ lab }) {
  await lab.reset({ map: 'colon' });
  const { page } = lab;
  const fine = await until('blocks', () => page.getByTestId('blocks').textContent());
  const [rectangles, alone] = fine.match(/\d+/g).map(Number);
  check(rectangles > 0 && rectangles < alone, `it says: ${fine}`);
  const smallest = page.getByRole('spinbutton', { name: 'Smallest block' });
  await page.getByText('Camera', { exact: true }).last().click();
  await smallest.fill('50');
  await smallest.press('Enter');
  await until('fewer blocks', async () => {
    const [few] = (await page.getByTestId('blocks').textContent()).match(/\d+/g).map(Number);
    return few < rectangles;
  });

  // Beside the tool and leaning toward it.
  const seen = JSON.stringify(lab.scene.camera_sees_m);
  for (const [name, value] of [
    ['Offset y', '8'],
    ['Tilt y', '-15'],
  ]) {
    const field = page.getByRole('spinbutton', { name, exact: true });
    await field.fill(value);
    await field.press('Enter');
  }
  await page.getByLabel('Magnet in the picture').check();
  await until('another view', () => JSON.stringify(lab.scene.camera_sees_m) !== seen);
  await page.getByLabel('Blocks', { exact: true }).selectOption('rectangles');
  await lab.run();
  await until('a second', () => lab.state.sim_time_s > 1);
  await lab.pause();

  const here = lab.state.tool_m;
  const look = () => lab.look([here[0] + 0.25 * (here[0] > 0 ? -1 : 1), here[1]]);
  const bare = await look();
  await lab.layer('Seen so far');
  await until('the unseen in gray', async () => (await look()) !== bare);
  for (const name of ['Quadtree', 'Rectangles']) await lab.layer(name);
  await lab.screenshot('camera-aside');
  for (const name of ['Seen so far', 'Quadtree', 'Rectangles']) await lab.layer(name, false);
  await page.getByLabel('Blocks', { exact: true }).selectOption('none');
  await lab.button('Restore defaults').click();
  await until('the usual view', () => JSON.stringify(lab.scene.camera_sees_m) === seen);
}

async function kicksTheBead({ lab }) {
  await lab.reset();
  const disturbances = await lab.number('disturbances');
  const bead = await lab.point('bead');
  await lab.run();
  await lab.button('Disturb').click();
  await lab.page.getByLabel('Direction of kick and push').selectOption('right');
  const strength = lab.page.getByLabel('Strength of the kick in mN·s');
  await strength.fill('0.8');
  await strength.press('Enter');
  await until('a moved bead', () => lab.state.bead_m[0] - bead[0] > 0.02);
  await until('a count', async () => (await lab.number('disturbances')) === disturbances + 1);
  await lab.page.getByRole('log').getByText('a kick of 0.80 mN·s').waitFor();
  await lab.screenshot('kick');
  await lab.button('Disturb').click();
  await lab.pause();
}

async function goesBackInTime({ lab }) {
  await lab.reset({ speed: '8' });
  await lab.run();
  await until('three seconds', () => lab.state.sim_time_s > 3);
  await lab.pause();
  const end = lab.state.tick;
  const box = await lab.page.getByLabel('Timeline').boundingBox();
  await lab.page.mouse.click(box.x + 0.4 * box.width, box.y + box.height / 2);
  await until('an earlier tick', () => lab.state.tick < 0.6 * end);
  const earlier = lab.state.tick;

  // By keyboard from one control step to the next, both ways.
  const timeline = lab.page.getByLabel('Timeline');
  const thumb = async () => Number(await timeline.inputValue());
  await timeline.focus();
  await lab.page.keyboard.press('ArrowRight');
  const next = await until('the next step', () => lab.state.tick > earlier && lab.state.tick);
  check(next - earlier >= 31 && next - earlier <= 32, `from ${earlier} it went to ${next}`);
  await until('its thumb', async () => (await thumb()) === next);
  await lab.page.keyboard.press('ArrowLeft');
  await until('the step before', () => lab.state.tick === earlier);
  await until('its thumb again', async () => (await thumb()) === earlier);

  // Away and back to where it began: what runs on moves the thumb again.
  const y = box.y + box.height / 2;
  const { mouse } = lab.page;
  const share = await timeline.evaluate((one) => (one.value - one.min) / (one.max - one.min));
  const at = box.x + 8 + share * (box.width - 16);
  await mouse.move(at, y);
  await mouse.down();
  await mouse.move(at - 60, y, { steps: 4 });
  await mouse.move(at, y, { steps: 4 });
  await mouse.up();
  await lab.page.waitForTimeout(500);
  const { tick } = lab.state;
  await lab.button('Step').click();
  await until('one tick', () => lab.state.tick === tick + 1);
  await until('a thumb that follows', async () => (await thumb()) === tick + 1);
}

async function looksRight({ lab, browser, server }) {
  await lab.reset({ speed: '4' });
  await lab.click(lab.freePoints(await lab.point('bead'), 0.2, 0.4)[0]);
  await lab.run();
  await until('some history', () => lab.state.sim_time_s > 6);
  await lab.pause();
  await lab.screenshot('dark');
  await lab.button('Use light colours').click();
  await lab.screenshot('light');
  await lab.button('Use dark colours').click();
  for (const [name, width, height] of [
    ['wide', 1440, 900],
    ['tablet', 820, 1180],
  ]) {
    for (const colorScheme of ['dark', 'light']) {
      const other = await Lab.open(browser, server.url, {
        viewport: { width, height },
        colorScheme,
      });
      await other.screenshot(`${name}-${colorScheme}`);
      await other.page.context().close();
    }
  }
}

async function isQuiet({ watch: { complaints, strangers } }) {
  check(complaints.length === 0, `the console says: ${complaints.join(' | ')}`);
  check(strangers.length === 0, `requests left the server: ${strangers.join(' ')}`);
}

/** Last, because it ends the server. */
async function saysThatTheServerIsGone({ lab, server }) {
  if (!server.kill) return;
  await server.kill();
  await until('reconnecting', async () =>
    (await lab.text('connection')).startsWith('reconnecting'),
  );
  check(await lab.button('Run').isDisabled(), 'Run is still offered');
}

export const TESTS = [
  ['opens as the operator, paused', opens],
  ['delivers the bead to a clicked goal', deliversToAClick],
  ['recovers when the mouse drags the bead away', recoversFromADisturbance],
  ['refuses a goal in a wall, beside it', refusesAGoalInAWall],
  ['obeys the keyboard', obeysTheKeyboard],
  ['binds parameters both ways', bindsParametersBothWays],
  ['shows what the magnet can', showsWhatTheMagnetCan],
  ['shows singularities', showsSingularities],
  ["shows the magnet's field", showsTheField],
  ['shows what the camera tells', showsWhatTheCameraTells],
  ['decides by quantiles', decidesByQuantiles],
  ['says that the policy has not seen a map', saysWhatThePolicyHasNotSeen],
  ['carries the bead along a planned way', carriesAlongAWay],
  ['shows where the attractor leads', showsWhereTheAttractorLeads],
  ['kicks the bead', kicksTheBead],
  ['goes back in time', goesBackInTime],
  ['tells why a switch came', tellsWhy],
  ['keeps a drag as a test case', keepsADragAsACase],
  ['compares controllers from a moment on', comparesControllers],
  ['shows that the bead can be taken', showsThatTheBeadCanBeTaken],
  ['puts the bead down while paused', placesTheBeadWhilePaused],
  ['lets go by itself', letsGoByItself],
  ['lets go when the socket is lost', letsGoWhenTheSocketIsLost],
  ['follows a finger', followsAFinger],
  ["plots the paper's figure", plotsThePapersFigure],
  ['bends the curves beside them', bendsTheCurvesBesideThem],
  ['disturbs by script', disturbsByScript],
  ['keeps time', keepsTime],
  ['obeys keys all over', obeysKeysAllOver],
  ['says what happens', saysWhatHappens],
  ['shares an experiment', sharesAnExperiment],
  ['refuses a broken link', refusesABrokenLink],
  ['loads a preset', loadsAPreset],
  ['learns by keyboard', learnsByKeyboard],
  ['every lesson shows what it claims', everyLessonShowsWhatItClaims],
  ['a viewer may predict', aViewerMayPredict],
  ['places a goal in space', placesAGoalInSpace],
  ['disturbs in space', disturbsInSpace],
  ['turns the scene', turnsTheScene],
  ['shows the field in space', showsTheFieldInSpace],
  ['obeys the keyboard in space', obeysTheKeyboardInSpace],
  ['frees what the scene held', frees],
  ['goes back to the plan', goesBackToThePlan],
  ['says that there is no 3-D', saysWhatIsMissing],
  ['looks right', looksRight],
  ['lists recordings', listsRecordings],
  ['opens a recording', opensARecording],
  ['evaluates what is asked for by keyboard', evaluates],
  ['cancels an evaluation, which a viewer watches', cancelsAnEvaluation],
  ['sets a failure up again', setsAFailureUpAgain],
  ...HOLDS,
  ...MAPS,
  ...PAIR,
  ...PROOF,
  ...BUDGET,
  ...SESSIONS,
  ...LOGIN,
  ['is quiet and keeps to its server', isQuiet],
  ['says that the server is gone', saysThatTheServerIsGone],
];
