// Rows of the control table: bars, tabs, workspace, playback, maps, presets and layers.

import { expect } from '@playwright/test';
import type { InputMethod } from '../support/inputMethods';
import type { ControllerLabel, Lab } from '../support/lab';
import type { Panel } from '../support/labControls';
import { openMap } from '../support/maps';
import {
  ensureGoal,
  ensureHistory,
  ensurePaused,
  ensureRunning,
  freePointNearBead,
  open,
  openLayers,
  openSetUp,
  showPanel,
  showTabs,
} from '../support/preconditions';
import { until } from '../support/wait';
import { type Row, type Section, expanded, isPressed, isSelected, toggle, view } from './row';

const theme = (lab: Lab) => lab.page.evaluate(() => document.documentElement.dataset.theme);
const shownView = (lab: Lab) => lab.page.locator('[aria-current=page]').innerText();
const role = (lab: Lab) => lab.page.getByTestId('connection').getAttribute('data-role');
const trial = (lab: Lab) => lab.scene.trial;
const layers = (lab: Lab) =>
  lab.page.evaluate(() => {
    const stored = Object.entries(localStorage);
    return stored.filter(([key]) => key.startsWith('ferry.layer.')).sort();
  });
/** The shown panel of the inspector. */
const panel = async (lab: Lab) => {
  const shown = lab.page.locator('.inspector');
  if ((await shown.count()) === 0) return 'none';
  return shown.locator('[aria-selected=true], h2').first().innerText();
};
const part = (lab: Lab) =>
  lab.page.getByRole('radiogroup', { name: 'Test' }).locator('input:checked').inputValue();

const ensureTheme = (name: 'light' | 'dark') => async (lab: Lab) => {
  const button = lab.button(name === 'light' ? 'Light' : 'Dark');
  if (await button.count()) await button.click();
};
const ofTest = (from: Panel): Row => ({ see: part, ready: showPanel(from) });
const controller = (name: ControllerLabel): Row => ({
  see: (lab) => lab.state.controller,
  after: (lab) => until(name, () => lab.state.controller === name.toLowerCase()),
});
async function backToPosts(lab: Lab) {
  await showTabs(lab);
  await lab.map('posts');
}

async function typeSeed(input: InputMethod, locator: Parameters<InputMethod['press']>[0]) {
  const { keyboard } = input.page;
  const seed = Number(await locator.inputValue());
  // Enter resets the trial. Leaving the field does not.
  await locator.focus();
  if (input.name === 'keyboard') await keyboard.press('ArrowUp');
  else {
    await input.press(locator);
    await keyboard.press('Control+a');
    await keyboard.type(String((seed + 1) % 1000));
  }
  await keyboard.press('Enter');
}

export const VIEWS: Section = {
  name: 'views, colours and control',
  rows: {
    'link Lab': { see: shownView, ready: view('Recordings') },
    'link Recordings': { see: shownView, after: view('Lab') },
    'link Evaluate': { see: shownView, after: view('Lab') },
    'button Light': { see: theme, ready: ensureTheme('dark') },
    'button Dark': { see: theme, ready: ensureTheme('light') },
    'button More': toggle(expanded),
    'button Release control': { see: role, ready: open('More') },
    'button Take control': { see: role },
    'link Present': {
      see: (lab) => lab.page.url(),
      ready: open('More'),
      after: async (lab) => {
        const { origin } = new URL(lab.page.url());
        await lab.page.getByRole('heading', { name: 'Demonstration' }).waitFor();
        await lab.page.goBack();
        await lab.live();
        await lab.page.request.delete(`${origin}/api/sessions/demo`);
      },
    },
    ...Object.fromEntries(
      ['Now', 'Story', 'Learn', 'Play', 'Test', 'Tune'].map((name) => [
        `tab ${name}`,
        { see: isSelected, ready: showTabs },
      ]),
    ),
    'radio Compare': ofTest('Recovery'),
    'radio Recovery': ofTest('Compare'),
    'radio Disturb': ofTest('Compare'),
    'button Disturb': { see: panel, ready: showPanel('Now') },
    'button Layers': { see: panel, ready: showPanel('Now'), isToggle: true },
    'button Key': { see: panel, ready: showPanel('Now') },
    'button Close': { see: panel, ready: openLayers },
    'button /seed \\d+$|^Challenge /': { see: panel, ready: showPanel('Now'), isToggle: true },
    'button Plots': toggle(isPressed),
    'button Camera': toggle(expanded, showPanel('Now')),
    'button Curves': { see: panel, ready: showPanel('Now') },
    'button Share': toggle(expanded),
    'radio RL': controller('RL'),
    'radio ERRT': controller('ERRT'),
    'radio Attractor': controller('Attractor'),
  },
};

export const WORKSPACE: Section = {
  name: 'the workspace',
  rows: {
    'application Workspace': [
      {
        see: (lab) => lab.state.goal_m,
        act: (input) => input.placeGoal(freePointNearBead(input.lab)),
      },
      {
        see: (lab) => lab.state.bead_m,
        act: (input) => input.dragBead(),
        after: (lab) => until('no hand', () => !lab.state.hand_m),
      },
    ],
    'button Clear goal': { see: (lab) => lab.state.goal_m, ready: ensureGoal },
    'button Dismiss': {
      see: (lab) => lab.notice('workspace').count(),
      ready: async (lab) => {
        await lab.click(lab.wallPoint());
        await lab.notice('workspace').waitFor();
      },
    },
    'button Fit': {
      see: (lab) => lab.canvas.getAttribute('data-px-per-m'),
      ready: async (lab) => {
        await lab.canvas.press('+');
        await lab.button('Fit').waitFor();
      },
    },
    'radio quadtree': {
      see: (lab) => lab.page.locator('.patch .blocks').getAttribute('d'),
      ready: async (lab) => {
        await lab.panel('Now');
        if ((await lab.button('Camera').getAttribute('aria-expanded')) === 'false')
          await lab.button('Camera').click();
        if (!(await lab.page.getByTestId('blocks').count())) await lab.button('Step').click();
        await lab.page.getByTestId('blocks').waitFor();
      },
    },
    'radio rectangles': { see: (lab) => lab.page.locator('.patch .blocks').getAttribute('d') },
    'radio No blocks': { see: (lab) => lab.page.locator('.patch .blocks').getAttribute('d') },
  },
};

/** A reset keeps the run before it. */
async function ensureKeptRun(lab: Lab) {
  if (lab.scene.kept_runs.length > 0) return;
  const { trial: before } = lab.scene;
  await lab.button('Step').click();
  await until('a tick', () => lab.state.tick > 0);
  await lab.button('Reset').click();
  await until('a kept run', () => lab.scene.trial !== before && lab.scene.kept_runs.length > 0);
}

/** A tablet has the panel below the map, which has its greatest size. */
export const WIDE_WINDOW: Section = {
  name: 'a wide window',
  rows: {
    'button Hide the panel': { see: panel, ready: showPanel('Now') },
    'button Show the panel': {
      see: panel,
      ready: async (lab) => {
        const hide = lab.button('Hide the panel');
        if (await hide.count()) await hide.click();
      },
    },
    'button Fill': {
      see: (lab) => lab.canvas.getAttribute('data-px-per-m'),
      after: (lab) => lab.button('Show the panel').click(),
    },
  },
};

export const PLAYBACK: Section = {
  name: 'the playback bar',
  rows: {
    'button Run': { see: (lab) => lab.state.running, ready: ensurePaused },
    'button Pause': {
      see: (lab) => lab.state.running,
      ready: ensureRunning,
      after: ensurePaused,
    },
    'button Step': { see: (lab) => lab.state.tick },
    'slider Timeline': { see: (lab) => lab.state.tick, ready: ensureHistory },
    'button Reset': { see: trial },
    'combobox Speed': { see: (lab) => lab.state.speed_target },
    'button Live': {
      see: (lab) => lab.state.tick,
      ready: async (lab) => {
        await ensureHistory(lab);
        await lab.send({ type: 'rewind', tick: lab.state.oldest_tick });
        await until('the past', () => lab.state.tick < lab.state.newest_tick);
      },
    },
    'button /^Kept runs/': toggle(expanded, ensureKeptRun),
    'button /^Return to run/': {
      see: trial,
      ready: async (lab) => {
        await ensureKeptRun(lab);
        const button = lab.page.getByRole('button', { name: /^Kept runs/ });
        if ((await button.getAttribute('aria-expanded')) === 'false') await button.click();
      },
    },
  },
};

export const EXPERIMENTS: Section = {
  name: 'maps and presets',
  rowReady: openSetUp,
  after: showTabs,
  rows: {
    'radio /^(attractor-example(-arm)?|colon(-folds)?|open|posts|toy|u-turn|vessels)$/': {
      see: (lab) => lab.scene.map,
      // The one after “posts”, so that the keyboard presses an arrow once.
      act: (input) => input.pick(input.page.getByRole('radio', { name: 'toy', exact: true })),
      after: backToPosts,
    },
    'button Open SVG…': {
      see: (lab) => lab.scene.map,
      act: (input, locator) => openMap(input.page, () => input.press(locator)),
      // Removes the map: other tests on this server expect the shipped maps only.
      after: async (lab) => {
        const name = lab.scene.map;
        await backToPosts(lab);
        const { origin } = new URL(lab.page.url());
        const removed = await lab.page.request.delete(`${origin}/api/maps/${name}`);
        expect(removed.status()).toBe(204);
        await until('the removal of the map', () => lab.lists.maps?.includes(name) === false);
      },
    },
    'button Dismiss the report': {
      elsewhere: 'opens an uploaded map, and delivers the bead on it',
    },
    'button /^Let (explorer|general) carry$/': {
      elsewhere: 'a drawing brings its start and goal, and the shipped policies are tried on it',
    },
    'button Train a policy on it': {
      elsewhere: 'draws a maze, trains on it, uses the policy, and it delivers',
    },
    'spinbutton Seed': { see: (lab) => lab.scene.seed, act: typeSeed },
    'button New seed': { see: (lab) => lab.scene.seed },
    'combobox Preset': { see: trial },
  },
};

const LAYER_NAMES = [
  'Trails',
  'Capture',
  'Field and pull',
  'Recovery',
  'Ghosts',
  'Challenge: ghosts',
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
  'Rulers, cm',
];

export const LAYERS: Section = {
  name: 'layers',
  ready: openLayers,
  after: showTabs,
  rows: Object.fromEntries(LAYER_NAMES.map((name) => [`checkbox ${name}`, toggle(layers)])),
};
