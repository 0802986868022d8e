// Rows of the control table: bars, tabs, workspace, playback, maps, presets and layers.

import { expect } from '@playwright/test';
import type { InputMethod } from '../support/inputMethods';
import type { ControllerLabel, Lab } from '../support/lab';
import { openMap } from '../support/maps';
import {
  ensureGoal,
  ensureHistory,
  ensurePaused,
  ensureRunning,
  freePointNearBead,
  open,
} from '../support/preconditions';
import { until } from '../support/wait';
import { RESTORE } from './parameters';
import { type Row, type Section, expanded, toggle, view } from './row';

const isSelected: Row['see'] = (_lab, locator) => locator.getAttribute('aria-selected');
const theme = (lab: Lab) => lab.page.evaluate(() => document.documentElement.dataset.theme);
const shownView = (lab: Lab) => lab.page.locator('[aria-current=page]').innerText();
const role = (lab: Lab) => lab.text('role');
const trial = (lab: Lab) => lab.scene.trial;
const layers = (lab: Lab) =>
  lab.page.evaluate(() => {
    const stored = Object.entries(localStorage);
    return stored.filter(([key]) => key.startsWith('ferry.layer.')).sort();
  });

const ensureTheme = (name: 'light' | 'dark') => async (lab: Lab) => {
  const button = lab.button(`Use ${name} colours`);
  if (await button.count()) await button.click();
};
const controller = (name: ControllerLabel): Row => ({
  see: (lab) => lab.state.controller,
  after: (lab) => until(name, () => lab.state.controller === name.toLowerCase()),
});
const backToPosts = (lab: Lab) => lab.map('posts');

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
    'link Laboratory': { see: shownView, ready: view('Recordings') },
    'link Recordings': { see: shownView, after: view('Lab') },
    'link Evaluate': { see: shownView, after: view('Lab') },
    'button Use light colours': { see: theme, ready: ensureTheme('dark') },
    'button Use dark colours': { see: theme, ready: ensureTheme('light') },
    'button Release control': { see: role },
    'button Take control': { see: role },
    'tab Events': { see: isSelected },
    'tab Lessons': { see: isSelected },
    'tab Compare': { see: isSelected },
    'tab Recovery': { see: isSelected },
    'tab Challenge': { see: isSelected },
    'button Plots': {
      see: (_lab, locator) => locator.getAttribute('aria-pressed'),
      isToggle: true,
    },
    'button Camera': toggle(expanded, (lab) => lab.panel('Now')),
    'button Curves': {
      see: (lab) => lab.tab('Tune').getAttribute('aria-selected'),
      ready: (lab) => lab.panel('Now'),
    },
    'button Beside the workspace': toggle(expanded),
    'button Below the workspace': toggle(expanded),
    'button Share': toggle(expanded),
    'link Present': {
      see: (lab) => lab.page.url(),
      after: async (lab) => {
        const { origin } = new URL(lab.page.url());
        await lab.page.getByRole('heading', { name: 'Demonstration' }).waitFor();
        await lab.page.goBack();
        await lab.live();
        await lab.page.request.delete(`${origin}/api/sessions/demo`);
      },
    },
    'button Layers': toggle(expanded),
    'button Disturb': toggle(expanded),
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

export const PLAYBACK: Section = {
  name: 'the playback bar',
  rows: {
    'button Run': { see: (lab) => lab.state.running, ready: ensurePaused },
    'button Pause': {
      see: (lab) => lab.state.running,
      ready: ensureRunning,
      after: ensurePaused,
    },
    'button Step ¼ s': { see: (lab) => lab.state.tick },
    'button Step': { see: (lab) => lab.state.tick },
    'slider Timeline': { see: (lab) => lab.state.tick, ready: ensureHistory },
    'button Reset': { see: trial },
    'combobox Speed': { see: (lab) => lab.state.speed_target },
    'spinbutton Seed': { see: (lab) => lab.scene.seed, act: typeSeed },
    'button New seed': { see: (lab) => lab.scene.seed },
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
  rowReady: async (lab) => {
    const title = lab.page.getByTitle('Set up: map, preset, seed');
    if ((await title.getAttribute('aria-expanded')) === 'false') await title.click();
  },
  rows: {
    'radio /^(attractor-example(-arm)?|colon(-folds)?|open|posts|u-turn|vessels)$/': {
      see: (lab) => lab.scene.map,
      act: (input) => input.press(input.page.getByRole('radio', { name: 'open', exact: true })),
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
    'button Train a policy on it': {
      elsewhere: 'draws a maze, trains on it, uses the policy, and it delivers',
    },
    'button Restore defaults': RESTORE,
    'combobox Sensors': {
      see: (lab) => lab.scene.parameters.tracker_dropout,
      after: (lab) => lab.restoreDefaults(),
    },
    'combobox Camera mount': {
      see: (lab) => lab.scene.parameters.camera_sees_magnet,
      after: (lab) => lab.restoreDefaults(),
    },
    'combobox Robot': {
      see: (lab) => lab.scene.parameters.friction,
      after: (lab) => lab.restoreDefaults(),
    },
    'combobox Walls': {
      see: (lab) => lab.scene.parameters.peristalsis_amplitude_m,
      after: (lab) => lab.restoreDefaults(),
    },
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
];

export const LAYERS: Section = {
  name: 'layers',
  rowReady: open('Layers'),
  rows: Object.fromEntries(LAYER_NAMES.map((name) => [`checkbox ${name}`, toggle(layers)])),
};
