// Rows of the control table: experiment links, events and their explanations, comparisons, lessons.

import { expect } from '@playwright/test';
import type { Lab } from '../support/lab';
import { ensureGoal, ensureNoGoal, ensurePaused, open, showPanel } from '../support/preconditions';
import { must, until } from '../support/wait';
import { type Section, dialogs, downloads, expanded, isChecked, lastSent, toggle } from './row';

const COMPUTED_MS = 60_000;

const explanation = async (lab: Lab) =>
  (await dialogs(lab)) && lab.page.locator('#why-title, .why-sentence').allInnerTexts();
const lessonHeadings = (lab: Lab) => lab.page.locator('.lesson-head h2').count();
const step = (lab: Lab) => lab.page.locator('.lesson-steps [aria-current=step]').allInnerTexts();

async function close(lab: Lab) {
  const dialog = lab.page.getByRole('dialog');
  // By key, because the card moves while it loads.
  if (await dialog.count()) await dialog.press('Escape');
  await expect(dialog).toHaveCount(0);
}

/** Sets a goal that the tool has not reached yet. */
async function setNewGoal(lab: Lab) {
  await ensureNoGoal(lab);
  await ensureGoal(lab);
}

/** Opens the explanation of an event that has others before and after it. */
async function openExplanation(lab: Lab) {
  if (await dialogs(lab)) return;
  await showPanel('Story')(lab);
  await lab.page
    .getByRole('button', { name: /^Why: / })
    .nth(-2)
    .click();
  await lab.page.getByRole('dialog').waitFor();
}

const timeOf = (lab: Lab) => lab.label('Time of the ghosts');
const ghostTime = (lab: Lab) => timeOf(lab).inputValue();

/** Waits until all ghosts are computed: before that they do not play. */
async function ghostsComputed(lab: Lab) {
  await until('the ghosts', () => lab.comparison?.running === false, COMPUTED_MS);
  await expect
    .poll(() => timeOf(lab).evaluate((one: HTMLInputElement) => Number(one.max) - Number(one.min)))
    .toBeGreaterThan(0);
}

async function ensureGhosts(lab: Lab) {
  if (await lab.button('Clear ghosts').count()) return;
  // A far goal: on a short path the ghosts would arrive before the test pauses them.
  await ensureNoGoal(lab);
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.3, 0.5)[0]);
  for (const name of ['RL', 'ERRT']) await lab.label(`Compare ${name}`).uncheck();
  lab.sent = {};
  await lab.page.getByRole('button', { name: /^Compare from/ }).click();
  await until('the request', () => lab.sent.fork);
  await ghostsComputed(lab);
}

/** Plays the ghosts from their start. Near the end they would stop before the test pauses them. */
async function playGhosts(lab: Lab) {
  await ensureGhosts(lab);
  // Moving the slider pauses them.
  await timeOf(lab).fill(must(await timeOf(lab).getAttribute('min'), 'the start'));
  await lab.button('Play ghosts').click();
  await lab.button('Pause ghosts').waitFor();
}

async function clearGhosts(lab: Lab) {
  if (await lab.button('Clear ghosts').count()) await lab.button('Clear ghosts').click();
}

const sends = (type: string, ready: (lab: Lab) => Promise<unknown>) => ({
  see: lastSent(type),
  ready: async (lab: Lab) => {
    await ready(lab);
    lab.sent = {};
  },
});

/** Also waits for the file: the next row counts downloads, too. */
async function stopVideo(lab: Lab) {
  const downloading = lab.page.waitForEvent('download');
  await lab.button('Stop video').first().click();
  await downloading;
  await expect(lab.page.getByRole('timer')).toHaveCount(0);
}

export const SHARE: Section = {
  name: 'the experiment link',
  // A test case needs one.
  ready: ensureGoal,
  rowReady: open('Share'),
  rows: {
    'textbox /^Link: /': {
      see: (_lab, locator) =>
        locator.evaluate(
          (one: HTMLInputElement) => (one.selectionEnd ?? 0) - (one.selectionStart ?? 0),
        ),
    },
    'button /^Copy: /': {
      see: async (lab) => (await lab.page.locator('.link-done').allInnerTexts()).join(),
    },
    'button Picture (PNG)': { see: downloads },
    'link Test case': { see: downloads },
    'link Recording': { see: downloads },
    'link Input log': { see: downloads },
    'button Record video': {
      see: (lab) => lab.page.getByRole('timer').count(),
      after: stopVideo,
    },
    // One in the popover, one over the view.
    'button Stop video': { elsewhere: 'records a video of the view Plan' },
  },
};

export const EVENTS: Section = {
  name: 'events',
  ready: async (lab) => {
    // The explained event needs one before and one after it: a goal, its reaching and its delivery.
    await setNewGoal(lab);
    await ensurePaused(lab);
    await lab.deliver();
    await showPanel('Story')(lab);
  },
  rows: {
    // In the toolbar of the timeline.
    'button /^(?!Why)[A-Z][a-z -]* at \\d/': { see: dialogs, after: close },
    'button /^Why: /': { see: dialogs, after: close },
    'link Keep as test case': { see: downloads },
    'button Open test case…': { elsewhere: 'opens a saved test case and repeats its inputs' },
    'button Previous event': { see: explanation, ready: openExplanation, after: close },
    'button Next event': { see: explanation, ready: openExplanation, after: close },
    'button Close': { see: dialogs, ready: openExplanation },
    'button Rewind to here': { ...sends('rewind', openExplanation), after: close },
    'button Compare controllers from here': {
      ...sends('fork', openExplanation),
      after: ghostsComputed,
    },
  },
};

export const COMPARE: Section = {
  name: 'comparisons',
  ready: async (lab) => {
    await ensurePaused(lab);
    await showPanel('Compare')(lab);
  },
  rows: {
    'checkbox Compare RL': { see: isChecked, isToggle: true },
    'checkbox Compare ERRT': { see: isChecked, isToggle: true },
    'checkbox Compare Attractor': { see: isChecked, isToggle: true },
    'button /^Compare from/': {
      ...sends('fork', setNewGoal),
      // The goal of these ghosts is near. The rows below need ghosts with a longer path.
      after: async (lab) => {
        await ghostsComputed(lab);
        await clearGhosts(lab);
      },
    },
    'slider Time of the ghosts': { see: ghostTime, ready: ensureGhosts },
    'button Play ghosts': { see: ghostTime, ready: ensureGhosts },
    'button Pause ghosts': {
      see: (lab) => lab.button('Play ghosts').count(),
      ready: playGhosts,
    },
    'button Clear ghosts': {
      see: (lab) => lab.button('Clear ghosts').count(),
      ready: ensureGhosts,
    },
  },
};

const LESSON_TITLES = [
  'Meet the magnet',
  'Lift-off',
  'Lose the bead',
  'The threshold T',
  'The law to the letter',
  'Why the attractor gets stuck',
  'What ERRT remembers',
  'What the policy sees',
  'The gut moves',
  'Why learning fails',
  'How far the goal is felt',
  'A head start',
];
const OF_LESSONS = 'the link of a lesson opens it in a session of the pupil’s own';
const FIRST_CHOICES = /^(Right below the|A little behind|Far behind)/;

const allLessons = async (lab: Lab) => {
  const back = lab.button('All lessons');
  if (await back.count()) await back.click();
};
const openLesson = async (lab: Lab) => {
  if (await lab.button('All lessons').count()) return;
  await lab.page.getByRole('button', { name: /^Meet the magnet/ }).click();
};
/** Goes to the first step of the lesson and makes a prediction. */
const predict = async (lab: Lab) => {
  await openLesson(lab);
  while (await lab.button('Back').count()) await lab.button('Back').click();
  await lab.page.getByRole('radio', { name: FIRST_CHOICES }).first().check();
};
const goToRun = async (lab: Lab) => {
  await predict(lab);
  await lab.button('Next').click();
};

export const LESSONS: Section = {
  name: 'lessons',
  ready: showPanel('Learn'),
  rows: {
    ...Object.fromEntries(
      LESSON_TITLES.map((name) => [
        `button /^${name} /`,
        { see: lessonHeadings, after: allLessons },
      ]),
    ),
    'button /^Link to /': toggle(expanded, allLessons),
    'textbox /^Link: Lesson /': { elsewhere: OF_LESSONS },
    'button /^Copy: Lesson /': { elsewhere: OF_LESSONS },
    [`radio /${FIRST_CHOICES.source}/`]: { see: isChecked, ready: openLesson },
    'button Next': { see: step, ready: predict },
    'button Back': { see: step, ready: goToRun },
    'button Set it up': { see: (lab) => lab.scene.trial, ready: goToRun },
    'button Set it up again': { see: (lab) => lab.scene.trial },
    'button /^Train lesson-/': {
      elsewhere: 'the trainings of the lesson “Why learning fails” confirm its claim',
    },
    'button Finish': {
      elsewhere: 'does the first lesson by keyboard, and remembers it after a reload',
    },
    'button Next lesson': {
      elsewhere: 'does the first lesson by keyboard, and remembers it after a reload',
    },
    'button All lessons': { see: lessonHeadings, ready: openLesson },
    'button Start over': { see: (lab) => lab.button('Start over').isDisabled() },
  },
};
