// Rows of the control table: plots, 3-D view, magnet, disturbances, recordings, evaluations.

import { expect } from '@playwright/test';
import type { Lab } from '../support/lab';
import { startEvaluation } from '../support/evaluations';
import { openSceneView, showPanel } from '../support/preconditions';
import { cameraAtRest, freeInPicture, px } from '../support/scene';
import { must } from '../support/wait';
import { bound } from './parameters';
import {
  NOT_TESTED,
  type Row,
  type Section,
  type Work,
  dialogs,
  downloads,
  expanded,
  isChecked,
  isPressed,
  lastSent,
  toggle,
  valueOf,
  view,
} from './row';

const box: Row = { see: isChecked, isToggle: true };
const sentDisturbance = lastSent('disturb');
const script = (lab: Lab) => lab.scene.scenario.script;
const magnetFacts = (lab: Lab) => lab.page.locator('.magnet .facts').innerText();
const scenes = (lab: Lab) => lab.label('Scene').count();

const choose = (label: string, option: string) => (lab: Lab) =>
  lab.label(label).selectOption(option);
const kind = (option: string) => choose('Kind of disturbance', option);
const time = (option: string) => choose('When the disturbance happens', option);

/** A field or a select whose value the button of the disturbance bar sends. */
const sentByButton = (ready: Work, work?: 'choose'): Row => ({
  see: sentDisturbance,
  ready,
  act: async (input, locator) => {
    if (work === 'choose') await input.choose(locator);
    else await input.type(locator, (await locator.inputValue()) === '0.5' ? '0.7' : '0.5');
    await input.press(input.page.locator('.disturb button[type=submit]'));
  },
});

/** A field of a form. The test only types into it, because Enter would submit the form. */
const typed: Row = {
  see: valueOf,
  act: async (input, locator) => {
    const { keyboard } = input.page;
    if (input.name === 'keyboard') await locator.focus();
    else await input.press(locator);
    await keyboard.press('Control+a');
    await keyboard.type((await locator.inputValue()) === '2' ? '3' : '2');
  },
};

const RANDOM_MOVES = 'Number of random moves';

export const DISTURB: Section = {
  name: 'disturbances',
  ready: showPanel('Disturb'),
  rows: {
    'combobox Kind of disturbance': { see: valueOf, after: kind('kick') },
    'button Kick now': { see: (lab) => lab.events.length },
    'spinbutton Strength of the kick in mN·s': sentByButton(kind('kick')),
    'combobox Direction of kick and push': sentByButton(kind('kick'), 'choose'),
    'button Push now': { see: sentDisturbance, ready: kind('push') },
    'spinbutton Force of the push in mN': sentByButton(kind('push')),
    'spinbutton Duration of the push in seconds': sentByButton(kind('push')),
    'button Move now': { see: sentDisturbance, ready: kind('move') },
    'spinbutton x of the new place in metres': sentByButton(kind('move')),
    'spinbutton y of the new place in metres': sentByButton(kind('move')),
    'button Pick the new place on the map': {
      see: isPressed,
      ready: kind('move'),
      isToggle: true,
    },
    'button Blind tracker now': { see: sentDisturbance, ready: kind('blind') },
    'spinbutton Duration of the blindness in seconds': sentByButton(kind('blind')),
    'combobox When the disturbance happens': { see: valueOf, after: time('now') },
    'spinbutton Time in seconds': { see: valueOf, ready: time('time') },
    'spinbutton Control step on the way to a goal': { see: valueOf, ready: time('step') },
    'spinbutton x that the bead passes, in metres': { see: valueOf, ready: time('passes') },
    'spinbutton Within this distance of the place in cm': { see: valueOf, ready: time('near') },
    'spinbutton x of the place to reach in metres': { see: valueOf, ready: time('near') },
    'spinbutton y of the place to reach in metres': { see: valueOf, ready: time('near') },
    'button Pick the place to reach on the map': {
      see: isPressed,
      ready: time('near'),
      isToggle: true,
    },
    'button Add to script and restart': { see: script, ready: time('time') },
    'button /^Remove and restart: /': { see: script },
    'button Add random moves…': { see: (lab) => lab.label(RANDOM_MOVES).count() },
    // The restart of the row before sets this field again, a frame after the message.
    [`spinbutton ${RANDOM_MOVES}`]: { ...typed, ready: (lab) => lab.drawn() },
    'button Set and restart': {
      see: (lab) => lab.scene.trial,
      ready: async (lab) => {
        const field = lab.label(RANDOM_MOVES);
        await field.fill('0');
        if (await lab.button('Set and restart').isDisabled()) await field.fill('1');
      },
    },
  },
};

/** The button of a viewpoint. The button `from` sets another viewpoint first. */
const viewpoint = (from: string): Row => ({
  see: (lab) => lab.label('Scene').getAttribute('data-px-from-table'),
  ready: async (lab) => {
    await openSceneView(lab);
    await lab.button(from).click();
    await cameraAtRest(lab);
  },
});

export const SCENE_VIEW: Section = {
  name: 'the 3-D view',
  rows: {
    'radio 3-D': { see: scenes, after: (lab) => lab.radio('Plan').check() },
    'radio Plan': { see: scenes },
    'application Scene': {
      see: (lab) => lab.state.goal_m,
      ready: openSceneView,
      act: async (input, locator) => {
        const { lab, page } = input;
        await locator.scrollIntoViewIfNeeded();
        if (input.name === 'keyboard') {
          await locator.focus();
          for (const key of ['ArrowRight', 'ArrowUp', 'Enter']) await page.keyboard.press(key);
          return;
        }
        const at = await px(lab, await freeInPicture(lab, 0.03, 0.2));
        await (input.name === 'touch' ? page.touchscreen.tap(...at) : page.mouse.click(...at));
      },
    },
    'button Home': viewpoint('Top'),
    'button Top': viewpoint('Home'),
    'button Front': viewpoint('Home'),
    'button Side': { ...viewpoint('Home'), after: (lab) => lab.radio('Plan').check() },
    'checkbox /^These keys work everywhere/': {
      ...box,
      ready: (lab) => lab.button('Help').click(),
      after: (lab) => lab.page.keyboard.press('Escape'),
    },
    'link libraries and a font of others': {
      elsewhere: 'the help leads to the licences of all that the page is made of',
    },
    'button Help': {
      see: dialogs,
      after: (lab) => lab.page.keyboard.press('Escape'),
    },
  },
};

export const PLOTS: Section = {
  name: 'plots',
  ready: async (lab) => {
    for (const [name, attribute] of [
      ['Plots', 'aria-pressed'],
      ['More about plots', 'aria-expanded'],
    ] as const) {
      const button = lab.button(name);
      if ((await button.getAttribute(attribute)) === 'false') await button.click();
    }
  },
  rows: {
    'button More about plots': toggle(expanded),
    'checkbox x': box,
    'checkbox y': box,
    'checkbox Error x': box,
    'checkbox Error y': box,
    'checkbox Distance e, true': box,
    'combobox Time window of the plots': { see: valueOf },
    'checkbox Large plots': box,
    'button Save CSV': { see: downloads },
    'button Save PNG': { see: downloads },
    'button Save SVG': { see: downloads },
  },
};

export const MAGNET: Section = {
  name: 'the magnet',
  ready: showPanel('Tune'),
  rows: {
    'radio the bead': { see: magnetFacts },
    'radio x': { see: magnetFacts },
    'radio y': { see: magnetFacts },
    'spinbutton Tool height': bound('tool_height_m'),
    'slider Tool height slider': bound('tool_height_m'),
    'spinbutton Friction μ': bound('friction'),
    'slider Friction μ slider': bound('friction'),
    // One component for all fields that have help.
    'button /^Help: ./': toggle(expanded),
  },
};

export const RECORDINGS: Section = {
  name: 'recordings',
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
    // The rows.
    'button /^(?!Open|Rename|Delete).*\\d:\\d\\d/': {
      elsewhere: 'deletes a recording after a question',
    },
    // Rerun's viewer needs the WebGL arguments of rerun.spec.ts.
    'button /^Open /': { elsewhere: 'opens a recording in Rerun’s viewer' },
    'link /^Download /': { see: downloads },
    'button /^Rename /': { elsewhere: 'names a recording, also on a phone' },
    'button /^Delete /': { elsewhere: 'deletes a recording after a question' },
  },
};

/** Controls of a run and of its report. */
const REPORT_ROWS: Section['rows'] = {
  'button /per cell, seed/': {
    // The last evaluation of the list is shown first, so that the row changes to the first one.
    see: (_lab, locator) => locator.getAttribute('aria-current'),
    ready: (lab) =>
      lab.page
        .getByRole('button', { name: /per cell, seed/ })
        .last()
        .click(),
  },
  'link HTML': { see: downloads },
  'link JSON': { see: downloads },
  'link CSV': { see: downloads },
  'button Run': { elsewhere: 'runs an evaluation that is filled in by keyboard' },
  'button Cancel': { elsewhere: 'cancels an evaluation that a viewer watches' },
  'button /^Set it up: episode /': { elsewhere: 'sets up a failed episode again' },
  // Not tested: it appears only after more than 50 failures, which take minutes.
  'button /^Show more of /': { elsewhere: NOT_TESTED },
};

export const EVALUATE: Section = {
  name: 'evaluations',
  ready: async (lab) => {
    const { origin } = new URL(lab.page.url());
    for (const seed of [1, 2]) {
      await startEvaluation(lab.page.request, origin, {
        controllers: ['attractor'],
        maps: ['open'],
        disturbances: [0],
        episodes: 1,
        seed,
      });
    }
    await lab.view('Evaluate').click();
    await expect
      .poll(() => lab.page.getByRole('button', { name: /per cell, seed/ }).count())
      .toBeGreaterThan(1);
    must(await lab.page.getByRole('link', { name: 'JSON' }).getAttribute('href'), 'a report');
  },
  rows: {
    ...Object.fromEntries(
      [
        ...['RL', 'ERRT', 'Attractor'],
        ...['attractor-example', 'attractor-example-arm', 'colon', 'colon-folds', 'open'],
        ...['posts', 'toy', 'u-turn', 'vessels', '0', '3'],
      ].map((name) => [`checkbox ${name}`, box]),
    ),
    'combobox Policy of RL': {
      see: valueOf,
      after: (lab) => lab.label('Policy of RL').selectOption('auto'),
    },
    'combobox Vary a parameter': { see: valueOf, after: choose('Vary a parameter', '') },
    'combobox Vary a second parameter': {
      see: valueOf,
      ready: choose('Vary a parameter', 'friction'),
      after: choose('Vary a parameter', ''),
    },
    ...Object.fromEntries(
      ['From', 'To', 'Values'].map((name) => [
        `spinbutton ${name}`,
        {
          ...typed,
          ready: choose('Vary a parameter', 'friction'),
          after: choose('Vary a parameter', ''),
        },
      ]),
    ),
    'spinbutton Episodes per cell': typed,
    'spinbutton Seed': typed,
    ...REPORT_ROWS,
  },
};
