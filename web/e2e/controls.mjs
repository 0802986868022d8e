// Every control of the page by its accessible name, and what it changes. A control that is on the
// page and not in this table fails the tests, and so does a row whose control changes nothing.

import { until } from './harness.mjs';
import { PARAMETERS, RESTORE } from './parameters.mjs';
import { openMap } from './maps.mjs';
import { nearby, open, pause, run, withGoal, withHistory, withoutGoal } from './moments.mjs';
import { PAST } from './controlsPast.mjs';
import { TOOLS } from './controlsTools.mjs';

const expanded = (_lab, locator) => locator.getAttribute('aria-expanded');
const isSelected = (_lab, locator) => locator.getAttribute('aria-selected');
const isOpen = (_lab, locator) => locator.evaluate((one) => one.parentElement.open);
const theme = (lab) => lab.page.evaluate(() => document.documentElement.dataset.theme);
const view = (lab) => lab.page.locator('[aria-current=page]').innerText();
const role = (lab) => lab.text('role');
const trial = (lab) => lab.scene.trial;
const layers = (lab) =>
  lab.page.evaluate(() => JSON.parse(localStorage.getItem('ferry.layers'))?.sort());

const goTo = (name) => (lab) => lab.button(name).click();
const wearing = (wish) => async (lab) => {
  const button = lab.button(`Use ${wish} colours`);
  if (await button.count()) await button.click();
};
/** Pressed twice, it is as before. */
const toggle = (see, ready) => ({ see, ready, isToggle: true });
const summary = toggle(isOpen);
const layer = toggle(layers);
const controller = (wish) => ({
  see: (lab) => lab.state.controller,
  after: (lab) => until(wish, () => lab.state.controller === wish),
});

/** Whatever was loaded. */
const asBefore = async (lab, hand) => {
  await lab.page.getByLabel('Map', { exact: true }).selectOption('posts');
  await until('posts', () => lab.scene.map === 'posts');
  await choose('Attractor')(lab);
  await hand.press(lab.button('Restore defaults'));
  const { defaults } = lab.scene;
  await until('the defaults', () => {
    return JSON.stringify(lab.scene.parameters) === JSON.stringify(defaults);
  });
  await lab.drawn();
};

const choose = (name) => async (lab) => {
  await lab.page.getByRole('radio', { name, exact: true }).check();
  await until(name, () => lab.state.controller === name.toLowerCase());
};
const LABORATORY = {
  'button Laboratory': { see: view, ready: goTo('Recordings') },
  'button Recordings': { see: view, after: goTo('Laboratory') },
  'button Evaluate': { see: view, after: goTo('Laboratory') },
  'button Use light colours': { see: theme, ready: wearing('dark') },
  'button Use dark colours': { see: theme, ready: wearing('light'), after: wearing('dark') },
  'button Release control': { see: role },
  'button Take control': { see: role },

  'application Workspace': [
    { see: (lab) => lab.state.goal_m, act: (hand) => hand.placeGoal(nearby(hand.lab)) },
    {
      see: (lab) => lab.state.bead_m,
      act: (hand) => hand.dragBead(),
      after: (lab) => until('no hand', () => !lab.state.hand_m),
    },
  ],
  'button Clear goal': { see: (lab) => lab.state.goal_m, ready: withGoal },
  'button Dismiss': {
    see: (lab) => lab.notice('workspace').count(),
    ready: async (lab) => {
      await lab.click(lab.wallPoint());
      await lab.notice('workspace').waitFor();
    },
  },
  'combobox Blocks': {
    see: (lab) => lab.page.locator('.patch .blocks').getAttribute('d'),
    ready: async (lab) => {
      if (!(await lab.page.getByTestId('blocks').count())) await lab.button('Step').click();
      await lab.page.getByTestId('blocks').waitFor();
      await lab.page.getByLabel('Blocks', { exact: true }).selectOption('none');
    },
  },

  'button Run': { see: (lab) => lab.state.running, ready: pause },
  'button Pause': { see: (lab) => lab.state.running, ready: run, after: pause },
  'button Step ¼ s': { see: (lab) => lab.state.tick },
  'button Step': { see: (lab) => lab.state.tick },
  'slider Timeline': { see: (lab) => lab.state.tick, ready: withHistory },
  'button Reset': { see: trial },
  'combobox Speed': { see: (lab) => lab.state.speed_target },
  'combobox Map': {
    see: (lab) => lab.scene.map,
    after: async (lab) => {
      await lab.page.getByLabel('Map', { exact: true }).selectOption('posts');
      await until('posts', () => lab.scene.map === 'posts');
    },
  },
  'button Open map…': {
    see: (lab) => lab.scene.map,
    act: (hand, locator) => openMap(hand.page, () => hand.press(locator)),
    after: asBefore,
  },
  'spinbutton Seed': {
    see: (lab) => lab.scene.seed,
    act: async (hand, locator) => {
      const seed = Number(await locator.inputValue());
      // Leaving the field does not reset a trial: Enter does.
      await locator.focus();
      if (hand.name === 'keyboard') await hand.page.keyboard.press('ArrowUp');
      else {
        await hand.press(locator);
        await hand.page.keyboard.press('Control+a');
        await hand.page.keyboard.type(String((seed + 1) % 1000));
      }
      await hand.page.keyboard.press('Enter');
    },
  },
  'button New seed': { see: (lab) => lab.scene.seed },

  'tab Events': { see: isSelected },
  'tab Lessons': { see: isSelected },
  'tab Compare': { see: isSelected },
  'tab Magnet': { see: isSelected },
  'tab Plots': { see: isSelected },

  'button Restore defaults': RESTORE,

  'combobox Preset': { see: trial, after: asBefore },
  'button Share': toggle(expanded),
  'button Layers': toggle(expanded),
  'button Disturb': toggle(expanded),
};

const LAYERS = Object.fromEntries(
  [
    'Trails',
    'Capture',
    'Field and pull',
    'Ghosts',
    'Camera field',
    'Sensed',
    'Seen so far',
    'Quadtree',
    'Rectangles',
    'Value',
    'Plan',
    'Obstacles',
    'Attractor flow',
    'Singularity',
  ].map((name) => [`checkbox ${name}`, layer]),
);

/** What to open before the rows can be gone through. */
export const SECTIONS = [
  { rows: LABORATORY },
  {
    ready: async (lab) => {
      // Values take long, and only a goal has them.
      await withoutGoal(lab);
      // Nothing is stored before something is chosen.
      await lab.layer('Trails', false);
      await lab.layer('Trails');
    },
    rowReady: open('Layers'),
    rows: LAYERS,
    after: (lab) => lab.page.keyboard.press('Escape'),
  },
  {
    rows: {
      'radio RL': controller('rl'),
      'radio ERRT': controller('errt'),
      'radio Attractor': controller('attractor'),
    },
  },
  ...TOOLS,
  ...PAST,
  ...PARAMETERS.map(({ group, controller: name, rows }) => ({
    ready: async (lab) => {
      if (name) await choose(name)(lab);
      const details = lab.page.locator('details').filter({ has: lab.page.getByText(group) });
      if (!(await details.first().evaluate((one) => one.open))) {
        await details.first().locator('summary').click();
      }
    },
    rows: { [`summary ${group}`]: summary, ...rows },
  })),
];
