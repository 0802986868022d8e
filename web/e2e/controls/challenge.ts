// Rows of the control table: challenges.

import type { Lab } from '../support/lab';
import { showPanel } from '../support/preconditions';
import { until } from '../support/wait';
import { type Section, valueOf } from './row';

const PLAYED = 'a challenge from a link is played, explained and put on the board';
const VIEWER = 'a viewer gets a session of its own for the challenge of a link';
const NAME = 'easy-controls';

const challenge = (lab: Lab) => lab.scene.challenge;
const trial = (lab: Lab) => lab.scene.trial;

/** Of the browser. */
const tabs = (lab: Lab) => lab.page.context().pages().length;
async function closeOtherTabs(lab: Lab) {
  for (const one of lab.page.context().pages()) if (one !== lab.page) await one.close();
}

async function list(lab: Lab) {
  await showPanel('Play')(lab);
  if (lab.scene.challenge)
    await lab.page.getByRole('button', { name: /^(All challenges|Give up)$/ }).click();
  await until('no challenge', () => !lab.scene.challenge);
  await lab.button('Play this').waitFor();
}

async function begin(lab: Lab) {
  await list(lab);
  await lab.page.getByRole('textbox', { name: 'Word' }).fill(NAME.replace('easy-', ''));
  await lab.button('Play this').click();
  await until('the challenge', () => lab.scene.challenge === NAME && lab.state.tick === 0);
}

async function beginOnce(lab: Lab) {
  if (lab.scene.challenge !== NAME) await begin(lab);
}

async function spoil(lab: Lab) {
  await beginOnce(lab);
  await lab.button('Step').click();
  await until('it does not count', () => lab.state.attempt?.void);
}

export const CHALLENGE: Section = {
  name: 'challenges',
  ready: list,
  after: async (lab) => {
    await list(lab);
    await lab.controller('RL');
  },
  rows: {
    'button /^(Easy|Medium|Hard)/': { see: challenge, ready: list },
    'combobox Difficulty': {
      see: valueOf,
      ready: list,
      after: (lab) => lab.page.getByRole('combobox', { name: 'Difficulty' }).selectOption('easy'),
    },
    'textbox Word': {
      see: valueOf,
      ready: list,
      act: (input, locator) => input.type(locator, `by-${input.name}`),
      // With Enter, which the mouse does not press, the challenge begins.
      after: (lab, input) =>
        until('the challenge', () => input.name === 'mouse' || Boolean(lab.scene.challenge)),
    },
    'button Play this': {
      see: challenge,
      ready: async (lab) => {
        await list(lab);
        await lab.page.getByRole('textbox', { name: 'Word' }).fill('other');
      },
    },
    'link All boards': { see: tabs, ready: list, after: closeOtherTabs },
    'link Link': { elsewhere: PLAYED },
    'button Play in a session of your own': { elsewhere: VIEWER },
    'button Start': { see: (lab) => lab.state.running, ready: begin },
    'link Board': { see: tabs, ready: beginOnce, after: closeOtherTabs },
    'button From the start': { see: trial, ready: beginOnce },
    'button Try again': { see: trial, ready: spoil },
    'button Result': { elsewhere: PLAYED },
    'button Show this moment': { elsewhere: PLAYED },
    'textbox Your name': { elsewhere: PLAYED },
    'textbox Class (if you wish)': { elsewhere: PLAYED },
    'button Put it on the board': { elsewhere: PLAYED },
    'button All challenges': { see: challenge, ready: beginOnce },
  },
};
