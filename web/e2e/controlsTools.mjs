// Rows of the table of controls: plots, magnet, disturbances, space, recordings, evaluations.

import { inSpace, open, pause, withoutGoal } from './moments.mjs';
import { bound } from './parameters.mjs';
import { freeInPicture, px } from './scene.mjs';

const value = (_lab, locator) => locator.inputValue();
const isChecked = (_lab, locator) => locator.isChecked();
const isPressed = (_lab, locator) => locator.getAttribute('aria-pressed');
const downloads = (lab) => lab.downloads;
const box = { see: isChecked, isToggle: true };
const tab = (name) => (lab) => lab.page.getByRole('tab', { name, exact: true }).click();
const view = (name) => (lab) =>
  lab.page.getByRole('navigation', { name: 'Views' }).getByRole('button', { name }).click();
const disturbed = (lab) => JSON.stringify(lab.sent.disturb ?? null);
const script = (lab) => JSON.stringify(lab.scene.scenario.script);
const magnetFact = (lab) => lab.page.locator('.magnet-words .facts').innerText();
const dialogs = (lab) => lab.page.getByRole('dialog').count();
const scenes = (lab) => lab.page.getByLabel('Scene', { exact: true }).count();
const radio = (name) => (lab) => lab.page.getByRole('radio', { name, exact: true }).check();

const choose = (label, option) => (lab) =>
  lab.page.getByLabel(label, { exact: true }).selectOption(option);
const kind = (option) => choose('Kind of disturbance', option);
const time = (option) => choose('Time of the disturbance', option);

/** A field or a choice that goes out with the button of the bar. */
const strikes = (ready, work) => ({
  see: disturbed,
  ready,
  act: async (hand, locator) => {
    if (work === 'choose') await hand.choose(locator);
    else await hand.type(locator, (await locator.inputValue()) === '0.5' ? '0.7' : '0.5');
    const { page } = hand;
    await hand.press(page.locator('.disturb button[type=submit]').first());
  },
});

/** A field of a form that Enter would send away: only typed into. */
const typed = {
  see: value,
  act: async (hand, locator) => {
    const { keyboard } = hand.page;
    if (hand.name === 'keyboard') await locator.focus();
    else await hand.press(locator);
    await keyboard.press('Control+a');
    await keyboard.type((await locator.inputValue()) === '2' ? '3' : '2');
  },
};

const DISTURB = {
  ready: async (lab) => {
    await withoutGoal(lab);
    await open('Disturb')(lab);
  },
  rows: {
    'combobox Kind of disturbance': { see: value, after: kind('kick') },
    'button Kick now': { see: (lab) => lab.events.length },
    'spinbutton Strength of the kick in mN·s': strikes(kind('kick')),
    'combobox Direction of kick and push': strikes(kind('kick'), 'choose'),
    'button Push now': { see: disturbed, ready: kind('push') },
    'spinbutton Force of the push in mN': strikes(kind('push')),
    'spinbutton Duration of the push in seconds': strikes(kind('push')),
    'button Blind tracker now': { see: disturbed, ready: kind('blind') },
    'spinbutton Duration of the blindness in seconds': strikes(kind('blind')),
    'combobox Time of the disturbance': { see: value, after: time('now') },
    'spinbutton Time in seconds': { see: value, ready: time('time') },
    'spinbutton Control step on the way to a goal': { see: value, ready: time('step') },
    'spinbutton x that the bead passes, in metres': { see: value, ready: time('passes') },
    'spinbutton Distance from the place in cm': { see: value, ready: time('near') },
    'button Add to script and restart': { see: script, ready: time('time') },
    'button /^Remove and restart: /': { see: script },
    // The restart of the row before sets it once more, a frame after the message.
    'spinbutton Number of random moves': { ...typed, ready: (lab) => lab.drawn() },
    'button Set and restart': {
      see: (lab) => lab.scene.trial,
      ready: async (lab) => {
        const field = lab.page.getByLabel('Number of random moves', { exact: true });
        await field.fill('0');
        if (await lab.button('Set and restart').isDisabled()) await field.fill('1');
      },
    },
  },
  after: async (lab) => {
    await lab.drawn();
    await lab.page.getByLabel('Number of random moves', { exact: true }).fill('0');
    const set = lab.button('Set and restart');
    if (await set.isEnabled()) await set.click();
    await lab.button('Disturb').click();
  },
};

/** From where the scene is looked at: from elsewhere, first. */
const eye = (from) => ({
  see: (lab) => lab.page.getByLabel('Scene', { exact: true }).getAttribute('data-px-from-table'),
  ready: async (lab) => {
    await radio('3-D')(lab);
    await inSpace(lab);
    await lab.button(from).click();
    await stands(lab);
  },
});

/** The eye flies, and then it rests. */
async function stands(lab) {
  const scene = lab.page.getByLabel('Scene', { exact: true });
  const look = () => scene.getAttribute('data-px-from-table');
  let before;
  for (let now = await look(); now !== before; now = await look()) {
    before = now;
    await lab.page.waitForTimeout(150);
  }
}

const SPACE = {
  rows: {
    'radio 3-D': { see: scenes, after: radio('Plan') },
    'radio Plan': { see: scenes },
    'application Scene': {
      see: (lab) => lab.state.goal_m,
      ready: async (lab) => {
        await pause(lab);
        await radio('3-D')(lab);
        await inSpace(lab);
      },
      act: async (hand, locator) => {
        const { lab, page } = hand;
        await locator.scrollIntoViewIfNeeded();
        if (hand.name === 'keyboard') {
          await locator.focus();
          for (const key of ['ArrowRight', 'ArrowUp', 'Enter']) await page.keyboard.press(key);
          return;
        }
        const at = await px(lab, await freeInPicture(lab, 0.03, 0.2));
        await (hand.name === 'touch' ? page.touchscreen.tap(...at) : page.mouse.click(...at));
      },
      after: radio('Plan'),
    },
    'button Home': eye('Top'),
    'button Top': eye('Home'),
    'button Front': eye('Home'),
    'button Side': { ...eye('Home'), after: radio('Plan') },
    'checkbox /^Keys work all over the page/': {
      ...box,
      ready: (lab) => lab.button('Keyboard shortcuts').click(),
      after: (lab) => lab.page.keyboard.press('Escape'),
    },
    'button Keyboard shortcuts': {
      see: dialogs,
      after: (lab) => lab.page.keyboard.press('Escape'),
    },
  },
};

const PLOTS = {
  ready: tab('Plots'),
  rows: {
    'combobox Window of the plots': { see: value },
    'button Save CSV': { see: downloads },
    'button Save PNG': { see: downloads },
    'button Save SVG': { see: downloads },
    'button Larger': { see: isPressed, isToggle: true },
  },
};

const MAGNET = {
  ready: tab('Magnet'),
  rows: {
    'radio the bead': { see: magnetFact },
    'radio x': { see: magnetFact },
    'radio y': { see: magnetFact },
    'combobox Magnet': bound('block_orientation'),
    'spinbutton Height': bound('tool_height_m'),
    'slider Height slider': bound('tool_height_m'),
    'spinbutton Friction': bound('friction'),
    'slider Friction slider': bound('friction'),
  },
  after: tab('Plots'),
};

const RECORDINGS = {
  ready: view('Recordings'),
  rows: {
    'button Refresh': {
      see: (lab) =>
        lab.page.evaluate(
          () =>
            performance
              .getEntriesByType('resource')
              .filter(({ name }) => name.endsWith('/api/recordings')).length,
        ),
    },
    // Rerun's viewer wants another browser than this one.
    'button /^Open /': { elsewhere: 'opens a recording' },
    'link /^Download /': { see: downloads },
  },
  after: view('Laboratory'),
};

const EVALUATE = {
  ready: view('Evaluate'),
  rows: {
    ...Object.fromEntries(
      [
        ...['RL', 'ERRT', 'Attractor'],
        ...['attractor-example', 'attractor-example-arm', 'colon', 'colon-folds', 'open'],
        ...['posts', 'vessels', '0', '3'],
      ].map((name) => [`checkbox ${name}`, box]),
    ),
    'spinbutton Episodes a cell': typed,
    'spinbutton Seed': typed,
    // What only some evaluations have; evaluate.mjs makes them have it.
    'button Run': { elsewhere: 'evaluates what is asked for by keyboard' },
    'button Cancel': { elsewhere: 'cancels an evaluation, which a viewer watches' },
    'button /^Set it up: episode /': { elsewhere: 'sets a failure up again' },
    'button /a cell, seed/': {
      // The last one begun is shown, the first of the list; the last of the list is another one.
      least: 2,
      see: (_lab, locator) => locator.getAttribute('aria-current'),
      before: (lab) =>
        lab.page
          .getByRole('button', { name: /a cell, seed/ })
          .last()
          .click(),
    },
    'button /^Show more of /': {
      least: 1,
      see: (lab) => lab.page.getByRole('row').count(),
    },
    'link HTML': { least: 1, see: downloads },
    'link JSON': { least: 1, see: downloads },
    'link CSV': { least: 1, see: downloads },
  },
  after: view('Laboratory'),
};

export const TOOLS = [PLOTS, SPACE, MAGNET, DISTURB, RECORDINGS, EVALUATE];
