// Links, presets and lessons: experiments as text, and what one learns from them.

import { check, until } from './harness.mjs';
import { Lab } from './lab.mjs';

const LESSON_MS = 120_000;

const fieldOf = (lab) => lab.page.getByLabel('Link to this experiment');

async function sharedLink(lab) {
  await lab.button('Share').click();
  const link = await fieldOf(lab).inputValue();
  await lab.page.keyboard.press('Escape');
  await fieldOf(lab).waitFor({ state: 'detached' });
  return link;
}

/** As if somebody had typed it after the page's address. */
async function visit(lab, hash) {
  await lab.page.evaluate((text) => {
    document.location.hash = text;
  }, hash);
}

/** Another map would be loaded with the parameters that the page knows of. */
async function defaults(lab) {
  await lab.button('Restore defaults').click();
  await until('the defaults', () => {
    const { defaults, parameters } = lab.scene;
    return Object.entries(defaults).every(([name, value]) => parameters[name] === value);
  });
  await lab.drawn();
}

async function tune(lab, name, value) {
  const input = lab.page.getByRole('spinbutton', { name, exact: true });
  await input.fill(value);
  await input.press('Enter');
}

export async function sharesAnExperiment({ lab, browser }) {
  const { page } = lab;
  await lab.reset({ map: 'colon' });
  await page.getByRole('radio', { name: 'ERRT', exact: true }).check();
  await until('ERRT', () => lab.state.controller === 'errt');
  await tune(lab, 'Threshold T', '8');
  await tune(lab, 'Fetch radius', '1.5');
  await until('both', () => lab.scene.parameters.fetch_radius_m === 0.015);
  await lab.click(lab.freePoints(await lab.point('bead'), 0.1, 0.3)[0]);
  await until('a goal', () => lab.state.goal_m);

  await lab.button('Share').click();
  await lab.button('Copy').click();
  await page.getByRole('status').getByText('Copied.').or(page.getByText('Selected:')).waitFor();
  await lab.screenshot('share');
  await page.keyboard.press('Escape');
  const link = await sharedLink(lab);
  for (const part of ['map=colon', 'controller=errt', 'threshold_m=0.08', 'fetch_radius_m=0.015']) {
    check(link.includes(part), `${part} is not in ${link}`);
  }
  const { seed } = lab.scene;
  const start = await lab.point('bead');
  await defaults(lab);
  await lab.reset({ map: 'posts' });

  // As a viewer it asks first; when control is free, Load takes it.
  const second = await Lab.open(browser, link);
  const bar = second.page.getByRole('alert', { name: 'Link' });
  await bar.getByText('This link asks for map colon, ERRT').waitFor();
  await second.screenshot('link-asks');
  check(second.scene.map === 'posts', 'a viewer loaded it');
  await lab.button('Release control').click();
  await until('a viewer', async () => (await lab.text('role')) === 'viewer');
  await bar.getByRole('button', { name: 'Load' }).click();
  await until('the colon', () => second.scene.map === 'colon' && second.state.goal_m);
  const same = {
    seed: second.scene.seed === seed,
    controller: second.state.controller === 'errt',
    parameters: second.scene.parameters.threshold_m === 0.08,
    start: String(await second.point('bead')) === String(start),
    link: (await sharedLink(second)) === link,
  };
  for (const [what, is] of Object.entries(same)) check(is, `${what} did not come through ${link}`);
  await until('no question', async () => (await bar.textContent()) === '');

  // It is a question once: control given and taken, another map; the address stays as it is.
  await second.reset({ map: 'open' });
  await second.button('Release control').click();
  await lab.button('Take control').click();
  await until('the operator', async () => (await lab.text('role')) === 'operator');
  check(second.scene.map === 'open', 'it was loaded again');
  await second.page.close();

  // An operator's page loads what its address says, at once and when opened.
  await visit(lab, new URL(link).hash);
  await until('the colon', () => lab.scene.map === 'colon' && lab.state.goal_m);
  await defaults(lab);
  await lab.reset({ map: 'posts' });
  await page.reload();
  await until('the colon again', () => lab.scene.map === 'colon');
  await until('live', async () => (await lab.text('connection')) === 'live');
  await visit(lab, '');
  await defaults(lab);
}

export async function refusesABrokenLink({ lab }) {
  await lab.reset();
  const before = await sharedLink(lab);
  const bar = lab.page.getByRole('alert', { name: 'Link' });
  await visit(lab, '#v=1&map=liver&controller=errt&seed=1');
  await bar.getByText('map is “liver”').waitFor();
  await lab.screenshot('link-broken');
  await bar.getByRole('button', { name: 'Dismiss the link' }).click();
  await until('no message', async () => (await bar.textContent()) === '');

  // What only the server can know.
  await visit(lab, '#v=1&map=posts&controller=errt&seed=1&friction=7');
  await lab.notice('controller').getByText('friction is 7').waitFor();
  check((await sharedLink(lab)) === before, 'something was loaded');
  await visit(lab, '');
}

export async function loadsAPreset({ lab }) {
  await lab.reset();
  const presets = lab.page.getByLabel('Preset', { exact: true });
  const shown = () => presets.evaluate((one) => one.selectedOptions[0].textContent);
  check((await shown()) === 'Preset…', `it shows ${await shown()}`);
  await presets.selectOption('A shaken table, T = 3 cm');
  await until('it', () => lab.scene.map === 'open' && lab.scene.parameters.threshold_m === 0.03);
  check(lab.scene.scenario.script.length === 4, 'no kicks');
  await until('its name', async () => (await shown()) === 'A shaken table, T = 3 cm');
  await lab.button('Restore defaults').click();
  await until('its name no more', async () => (await shown()) === 'Preset…');
}

const lessonsTab = (lab) => lab.page.getByRole('tab', { name: 'Lessons' });

async function next(lab) {
  const button = lab.button('Next');
  await until('Next', () => button.isEnabled(), LESSON_MS);
  await button.click();
}

/** Sets up what a step asks for and runs it as fast as it goes, with the lesson's own buttons. */
async function runStep(lab, action, after, speed) {
  const { trial } = lab.scene;
  await lab.button('Set it up').click();
  await until('another trial', () => lab.scene.trial !== trial && lab.state.tick === 0);
  await lab.button('Set it up again').waitFor();
  await lab.speed(speed);
  await lab.run();
  if (action) {
    const tasks = lab.page.locator('.lesson-tasks li.done');
    await tasks.getByText(after).waitFor({ timeout: LESSON_MS });
    const done = lab.button('Next');
    await until(
      action,
      async () => {
        await lab.button(action).click();
        await lab.page.waitForTimeout(700);
        return action.startsWith('Lower') ? done.isEnabled() : true;
      },
      LESSON_MS,
    );
  }
  await until('all tasks', () => lab.button('Next').isEnabled(), LESSON_MS);
  await lab.pause();
}

/** Title, the right choice, runs, and of the first run the button to press, and after which task. */
const LESSONS = [
  ['Lose the bead', 'It flies to the bead', 1, ['Take it away for me', 'Time runs', '4']],
  ['The threshold T', 'It is fetched more often and arrives later', 2],
  ['The law to the letter', 'The two take turns', 2],
  ['Why the attractor gets stuck', 'Up to the wall', 2],
  ['What ERRT remembers', 'Once', 1, ['Send it back', 'Delivered there', '64']],
  ['What the policy sees', 'It loses its way', 2],
  ['Lift-off', 'Soon', 2, ['Lower by 2 mm', 'Time runs', '4']],
];

/** The first lesson, without a mouse. */
export async function learnsByKeyboard({ lab }) {
  const { page } = lab;
  const { keyboard } = page;
  await lab.reset();
  await page.getByRole('tab', { name: 'Events' }).focus();
  await keyboard.press('ArrowRight');
  await page.getByRole('button', { name: /^Meet the magnet/ }).focus();
  await keyboard.press('Enter');
  check(await lab.button('Next').isDisabled(), 'one may go on without a prediction');
  await page.getByLabel('Right below').focus();
  await keyboard.press(' ');
  await keyboard.press('ArrowDown');
  await until('a choice', () => page.getByLabel('A little behind').isChecked());
  await lab.screenshot('lesson-predict');
  await lab.button('Next').press('Enter');
  const { trial } = lab.scene;
  await lab.button('Set it up').press('Enter');
  await until('the table', () => lab.scene.trial !== trial && lab.scene.map === 'open');
  await until('its goal', () => lab.state.goal_m);
  // Its tasks are followed from the start on.
  await lab.button('Set it up again').waitFor();
  await lab.canvas.focus();
  await keyboard.press(' ');
  await page.locator('.lesson-tasks li.done').getByText('carried for 10 cm').waitFor();
  await lab.screenshot('lesson-run');
  await until('all tasks', () => lab.button('Next').isEnabled(), LESSON_MS);
  await keyboard.press(' ');
  await lab.button('Next').press('Enter');
  const outcome = await lab.text('lesson-outcome');
  check(outcome.startsWith('A little behind'), `it says: ${outcome}`);
  await lab.screenshot('lesson-explain');
  await lab.button('Finish').press('Enter');
  await page.getByText('1 of 8 done').waitFor();

  await page.reload();
  await until('live', async () => (await lab.text('connection')) === 'live');
  await lessonsTab(lab).click();
  await page.getByText('1 of 8 done').waitFor();
  await page.getByRole('button', { name: /^Meet the magnet/ }).click();
  check(await page.getByLabel('A little behind').isChecked(), 'the choice is forgotten');
  await lab.button('All lessons').click();
}

export async function everyLessonShowsWhatItClaims({ lab }) {
  const { page } = lab;
  await lessonsTab(lab).click();
  for (const [title, choice, runs, [action, after, speed = '64'] = []] of LESSONS) {
    await page.getByRole('button', { name: new RegExp(`^${title}`) }).click();
    await page.getByRole('radio', { name: choice }).check();
    await next(lab);
    for (let run = 0; run < runs; run += 1) {
      await runStep(lab, run === 0 ? action : undefined, after, speed);
      await next(lab);
    }
    const outcome = await lab.text('lesson-outcome');
    check(outcome.startsWith(choice), `${title} ended with: ${outcome}`);
    await lab.screenshot(`lesson-${title.toLowerCase().replaceAll(/\W+/g, '-')}`);
    await lab.button('Finish').click();
  }
  // With or without the one that is learned by keyboard.
  await page.getByText(/[78] of 8 done/).waitFor();
  await lab.screenshot('lessons-dark');
  await lab.button('Use light colours').click();
  await lab.screenshot('lessons-light');
  await lab.button('Use dark colours').click();
  await lab.button('Start over').click();
  await page.getByText('0 of 8 done').waitFor();
  await page.getByRole('tab', { name: 'Events' }).click();
}

export async function aViewerMayPredict({ lab, browser, server }) {
  const second = await Lab.open(browser, server.url);
  await lessonsTab(second).click();
  await second.page.getByRole('button', { name: /^Lose the bead/ }).click();
  await second.page.getByLabel('It stops until the bead is back').check();
  await next(second);
  check(await second.button('Set it up').isDisabled(), 'a viewer may set it up');
  await second.page.getByText('You are watching: take control').waitFor();
  await second.page.close();
  check(lab.scene, 'the operator is gone');
}
