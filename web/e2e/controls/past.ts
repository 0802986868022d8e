// Rows of the table of controls: experiment links, the story of an event, comparisons, lessons.

import { expect } from '@playwright/test';
import type { Lab } from '../support/lab';
import { open, pause, withGoal, withHistory, withoutGoal } from '../support/moments';
import { must, until } from '../support/wait';
import { type Section, dialogs, downloads, isChecked, lastSent, tab } from './row';

const COMPUTED_MS = 60_000;

const title = async (lab: Lab) =>
  (await dialogs(lab)) && lab.page.locator('#why-title, .why-sentence').allInnerTexts();
const heading = (lab: Lab) => lab.page.locator('.lesson-head h3').count();
const step = (lab: Lab) => lab.page.locator('.lesson-steps [aria-current=step]').allInnerTexts();

async function close(lab: Lab) {
  const dialog = lab.page.getByRole('dialog');
  if (await dialog.count()) await dialog.getByRole('button', { name: 'Close' }).click();
  await expect(dialog).toHaveCount(0);
}

/** One that is not reached yet. */
async function anotherGoal(lab: Lab) {
  await withoutGoal(lab);
  await withGoal(lab);
}

/** The story of an event that has others before and after it. */
async function inspect(lab: Lab) {
  if (await dialogs(lab)) return;
  await lab.tab('Events').click();
  await lab.page
    .getByRole('button', { name: /^Why: / })
    .nth(-2)
    .click();
  await lab.page.getByRole('dialog').waitFor();
}

const timeOf = (lab: Lab) => lab.label('Time of the ghosts');
const ghostTime = (lab: Lab) => timeOf(lab).inputValue();

/** All of them have come: until then they do not play. */
async function ghosts(lab: Lab) {
  await until('ghosts', () => lab.comparison?.running === false, COMPUTED_MS);
  await expect
    .poll(() => timeOf(lab).evaluate((one: HTMLInputElement) => Number(one.max) - Number(one.min)))
    .toBeGreaterThan(0);
}

async function withGhosts(lab: Lab) {
  if (await lab.button('Clear ghosts').count()) return;
  // Far off: a short path is over before the ghosts are stopped on it.
  await withoutGoal(lab);
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.3, 0.5)[0]);
  for (const name of ['RL', 'ERRT']) await lab.label(`Compare ${name}`).uncheck();
  lab.sent = {};
  await lab.button('Compare from here').click();
  await until('the request', () => lab.sent.fork);
  await ghosts(lab);
}

/** From their start: where others left them, they may be over before they are stopped. */
async function playGhosts(lab: Lab) {
  await withGhosts(lab);
  if (await lab.button('Pause ghosts').count()) await lab.button('Pause ghosts').click();
  await timeOf(lab).fill(must(await timeOf(lab).getAttribute('min'), 'the start'));
  await lab.button('Play ghosts').click();
  await lab.button('Pause ghosts').waitFor();
}

async function withoutGhosts(lab: Lab) {
  if (await lab.button('Clear ghosts').count()) await lab.button('Clear ghosts').click();
}

const asked = (type: string, ready: (lab: Lab) => Promise<unknown>) => ({
  see: lastSent(type),
  ready: async (lab: Lab) => {
    await ready(lab);
    lab.sent = {};
  },
});

const SHARE: Section = {
  name: 'the experiment link',
  rowReady: open('Share'),
  rows: {
    'textbox Link to this experiment': {
      see: (_lab, locator) =>
        locator.evaluate(
          (one: HTMLInputElement) => (one.selectionEnd ?? 0) - (one.selectionStart ?? 0),
        ),
    },
    'button Copy': { see: (lab) => lab.page.locator('.share-done').innerText() },
  },
};

const EVENTS: Section = {
  name: 'events',
  ready: async (lab) => {
    // Each goal is an event: some before the one whose story is opened, some after it.
    for (let i = 0; i < 2; i++) await anotherGoal(lab);
    await withHistory(lab);
    await lab.tab('Events').click();
  },
  rows: {
    // In the toolbar of the timeline.
    'button /^(?!Why)[A-Z][a-z -]* at \\d/': { see: dialogs, after: close },
    'button /^Why: /': { see: dialogs, after: close },
    'link Keep as test case': { see: downloads },
    'button Previous event': { see: title, ready: inspect, after: close },
    'button Next event': { see: title, ready: inspect, after: close },
    'button Close': { see: dialogs, ready: inspect },
    'button Rewind to here': { ...asked('rewind', inspect), after: close },
    'button Compare controllers from here': { ...asked('fork', inspect), after: ghosts },
  },
};

const COMPARE: Section = {
  name: 'comparisons',
  ready: async (lab) => {
    await pause(lab);
    await lab.tab('Compare').click();
  },
  rows: {
    'checkbox Compare RL': { see: isChecked, isToggle: true },
    'checkbox Compare ERRT': { see: isChecked, isToggle: true },
    'checkbox Compare Attractor': { see: isChecked, isToggle: true },
    'button Compare from here': {
      ...asked('fork', anotherGoal),
      // Their goal is near: those that are played below have a longer path.
      after: async (lab) => {
        await ghosts(lab);
        await withoutGhosts(lab);
      },
    },
    'slider Time of the ghosts': { see: ghostTime, ready: withGhosts },
    'button Play ghosts': { see: ghostTime, ready: withGhosts },
    'button Pause ghosts': {
      see: (lab) => lab.button('Play ghosts').count(),
      ready: playGhosts,
    },
    'button Clear ghosts': { see: (lab) => lab.button('Clear ghosts').count(), ready: withGhosts },
  },
};

const LESSON_TITLES = [
  'Meet the magnet',
  'Lose the bead',
  'The threshold T',
  'The law to the letter',
  'Why the attractor gets stuck',
  'What ERRT remembers',
  'What the policy sees',
  'Lift-off',
];
const FIRST_CHOICES = /^(Right below the|A little behind|Far behind)/;

const allLessons = async (lab: Lab) => {
  const back = lab.button('All lessons');
  if (await back.count()) await back.click();
};
const inLesson = async (lab: Lab) => {
  if (await lab.button('All lessons').count()) return;
  await lab.page.getByRole('button', { name: /^Meet the magnet/ }).click();
};
/** At its start, with a prediction made. */
const predicted = async (lab: Lab) => {
  await inLesson(lab);
  while (await lab.button('Back').isEnabled()) await lab.button('Back').click();
  await lab.page.getByRole('radio', { name: FIRST_CHOICES }).first().check();
};
const atRun = async (lab: Lab) => {
  await predicted(lab);
  await lab.button('Next').click();
};

const LESSONS: Section = {
  name: 'lessons',
  ready: tab('Lessons'),
  rows: {
    ...Object.fromEntries(
      LESSON_TITLES.map((name) => [`button /^${name} /`, { see: heading, after: allLessons }]),
    ),
    [`radio /${FIRST_CHOICES.source}/`]: { see: isChecked, ready: inLesson },
    'button Next': { see: step, ready: predicted },
    'button Back': { see: step, ready: atRun },
    'button Set it up': { see: (lab) => lab.scene.trial, ready: atRun },
    'button Set it up again': { see: (lab) => lab.scene.trial },
    'button All lessons': { see: heading, ready: inLesson },
    'button Start over': { see: (lab) => lab.button('Start over').isDisabled() },
  },
};

export const PAST: readonly Section[] = [SHARE, EVENTS, COMPARE, LESSONS];
