// Rows of the table of controls: plots, magnet, disturbances, the 3-D view, recordings, evaluations.

import { expect } from '@playwright/test';
import type { Lab } from '../support/lab';
import { startEvaluation } from '../support/evaluations';
import { inSpace, open } from '../support/moments';
import { arrived, freeInPicture, px } from '../support/space';
import { must } from '../support/wait';
import { bound } from './parameters';
import {
  type Row,
  type Section,
  type Work,
  dialogs,
  downloads,
  isChecked,
  lastSent,
  tab,
  valueOf,
  view,
} from './row';

const box: Row = { see: isChecked, isToggle: true };
const disturbed = lastSent('disturb');
const script = (lab: Lab) => lab.scene.scenario.script;
const magnetFact = (lab: Lab) => lab.page.locator('.magnet-words .facts').innerText();
const scenes = (lab: Lab) => lab.label('Scene').count();

const choose = (label: string, option: string) => (lab: Lab) =>
  lab.label(label).selectOption(option);
const kind = (option: string) => choose('Kind of disturbance', option);
const time = (option: string) => choose('Time of the disturbance', option);

/** A field or a choice that is sent with the button of the bar. */
const strikes = (ready: Work, work?: 'choose'): Row => ({
  see: disturbed,
  ready,
  act: async (hand, locator) => {
    if (work === 'choose') await hand.choose(locator);
    else await hand.type(locator, (await locator.inputValue()) === '0.5' ? '0.7' : '0.5');
    await hand.press(hand.page.locator('.disturb button[type=submit]').first());
  },
});

/** A field of a form that Enter would submit: only typed into. */
const typed: Row = {
  see: valueOf,
  act: async (hand, locator) => {
    const { keyboard } = hand.page;
    if (hand.name === 'keyboard') await locator.focus();
    else await hand.press(locator);
    await keyboard.press('Control+a');
    await keyboard.type((await locator.inputValue()) === '2' ? '3' : '2');
  },
};

const RANDOM_MOVES = 'Number of random moves';

const DISTURB: Section = {
  name: 'disturbances',
  ready: open('Disturb'),
  rows: {
    'combobox Kind of disturbance': { see: valueOf, after: kind('kick') },
    'button Kick now': { see: (lab) => lab.events.length },
    'spinbutton Strength of the kick in mN·s': strikes(kind('kick')),
    'combobox Direction of kick and push': strikes(kind('kick'), 'choose'),
    'button Push now': { see: disturbed, ready: kind('push') },
    'spinbutton Force of the push in mN': strikes(kind('push')),
    'spinbutton Duration of the push in seconds': strikes(kind('push')),
    'button Blind tracker now': { see: disturbed, ready: kind('blind') },
    'spinbutton Duration of the blindness in seconds': strikes(kind('blind')),
    'combobox Time of the disturbance': { see: valueOf, after: time('now') },
    'spinbutton Time in seconds': { see: valueOf, ready: time('time') },
    'spinbutton Control step on the way to a goal': { see: valueOf, ready: time('step') },
    'spinbutton x that the bead passes, in metres': { see: valueOf, ready: time('passes') },
    'spinbutton Distance from the place in cm': { see: valueOf, ready: time('near') },
    'button Add to script and restart': { see: script, ready: time('time') },
    'button /^Remove and restart: /': { see: script },
    // The restart of the row before sets it once more, a frame after the message.
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

/** The viewpoint: from another one, first. */
const viewpoint = (from: string): Row => ({
  see: (lab) => lab.label('Scene').getAttribute('data-px-from-table'),
  ready: async (lab) => {
    await inSpace(lab);
    await lab.button(from).click();
    await arrived(lab);
  },
});

const SPACE: Section = {
  name: 'the 3-D view',
  rows: {
    'radio 3-D': { see: scenes, after: (lab) => lab.radio('Plan').check() },
    'radio Plan': { see: scenes },
    'application Scene': {
      see: (lab) => lab.state.goal_m,
      ready: inSpace,
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
    },
    'button Home': viewpoint('Top'),
    'button Top': viewpoint('Home'),
    'button Front': viewpoint('Home'),
    'button Side': { ...viewpoint('Home'), after: (lab) => lab.radio('Plan').check() },
    'checkbox /^These keys work everywhere/': {
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

const PLOTS: Section = {
  name: 'plots',
  ready: tab('Plots'),
  rows: {
    'combobox Time window of the plots': { see: valueOf },
    'button Save CSV': { see: downloads },
    'button Save PNG': { see: downloads },
    'button Save SVG': { see: downloads },
    'button Larger': {
      see: (_lab, locator) => locator.getAttribute('aria-pressed'),
      isToggle: true,
    },
  },
};

const MAGNET: Section = {
  name: 'the magnet',
  ready: tab('Magnet'),
  rows: {
    'radio the bead': { see: magnetFact },
    'radio x': { see: magnetFact },
    'radio y': { see: magnetFact },
    'combobox Magnet': bound('block_orientation'),
    'spinbutton Height': bound('tool_height_m'),
    'slider Height slider': bound('tool_height_m', 'slider'),
    'spinbutton Friction': bound('friction'),
    'slider Friction slider': bound('friction', 'slider'),
  },
};

const RECORDINGS: Section = {
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
    // Rerun's viewer needs a browser with WebGL.
    'button /^Open /': { elsewhere: 'opens a recording in Rerun’s viewer' },
    'link /^Download /': { see: downloads },
  },
};

/** What only some evaluations have. */
const REPORT_ROWS: Section['rows'] = {
  'button /per cell, seed/': {
    // The last one is shown, the first of the list.
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
  'button Run': { elsewhere: 'evaluates what the keyboard chose' },
  'button Cancel': { elsewhere: 'cancels an evaluation that a viewer watches' },
  'button /^Set it up: episode /': { elsewhere: 'sets up a failed episode again' },
  // Only after more than 50 failures, which take minutes.
  'button /^Show more of /': { elsewhere: 'nowhere' },
};

const EVALUATE: Section = {
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
        ...['posts', 'vessels', '0', '3'],
      ].map((name) => [`checkbox ${name}`, box]),
    ),
    'spinbutton Episodes per cell': typed,
    'spinbutton Seed': typed,
    ...REPORT_ROWS,
  },
};

export const TOOLS: readonly Section[] = [PLOTS, SPACE, MAGNET, DISTURB, RECORDINGS, EVALUATE];
