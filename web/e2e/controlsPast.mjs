// Rows of the table of controls: links, the story of an event, comparisons, lessons.

import { until } from './harness.mjs';
import { open, pause, withGoal, withHistory, withoutGoal } from './moments.mjs';

const COMPUTED_MS = 60_000;

const isChecked = (_lab, locator) => locator.isChecked();
const dialogs = (lab) => lab.page.getByRole('dialog').count();
const title = async (lab) =>
  (await dialogs(lab)) && lab.page.locator('#why-title, .why-sentence').allInnerTexts();
const heading = (lab) => lab.page.locator('.lesson-head h3').count();
const step = (lab) => lab.page.locator('.lesson-steps [aria-current=step]').allInnerTexts();
const tab = (name) => (lab) => lab.page.getByRole('tab', { name }).click();

async function close(lab) {
  if (await dialogs(lab))
    await lab.page.getByRole('dialog').getByRole('button', { name: 'Close' }).click();
  await until('no story', async () => (await dialogs(lab)) === 0);
}

/** One that is not reached yet. */
async function anotherGoal(lab) {
  await withoutGoal(lab);
  await withGoal(lab);
}

/** The story of an event that has others before and after it. */
async function inspect(lab) {
  if (await dialogs(lab)) return;
  await tab('Events')(lab);
  await lab.page
    .getByRole('button', { name: /^Why: / })
    .nth(-2)
    .click();
  await lab.page.getByRole('dialog').waitFor();
}

/** They have come, and all their way: while they come they do not play. */
async function ghosts(lab) {
  await until('ghosts', () => lab.comparison && !lab.comparison.running, COMPUTED_MS);
  const time = lab.page.getByLabel('Time of the ghosts', { exact: true });
  await until('their time', () => time.evaluate((one) => one.max - one.min > 0));
}

async function withGhosts(lab) {
  if (await lab.button('Clear ghosts').count()) return;
  // Far off: a short way is over before the ghosts are stopped on it.
  await withoutGoal(lab);
  await lab.click(lab.freePoints(await lab.point('bead'), 0.3, 0.5)[0]);
  await until('a far goal', () => lab.state.goal_m);
  for (const name of ['RL', 'ERRT']) {
    await lab.page.getByLabel(`Compare ${name}`, { exact: true }).uncheck();
  }
  lab.sent.fork = undefined;
  await lab.button('Compare from here').click();
  await until('the question', () => lab.sent.fork);
  await ghosts(lab);
}

/** From their beginning: where others left them, they may be over before they are stopped. */
async function playGhosts(lab) {
  await withGhosts(lab);
  if (await lab.button('Pause ghosts').count()) await lab.button('Pause ghosts').click();
  const time = lab.page.getByLabel('Time of the ghosts', { exact: true });
  await time.fill(await time.getAttribute('min'));
  await lab.button('Play ghosts').click();
  await lab.button('Pause ghosts').waitFor();
}

async function withoutGhosts(lab) {
  if (await lab.button('Clear ghosts').count()) await lab.button('Clear ghosts').click();
}

const compared = (lab) => JSON.stringify(lab.sent.fork ?? null) + lab.state.tick;
const ghostTime = (lab) => lab.page.getByLabel('Time of the ghosts', { exact: true }).inputValue();

const LESSONS = [
  'Meet the magnet',
  'Lose the bead',
  'The threshold T',
  'The law to the letter',
  'Why the attractor gets stuck',
  'What ERRT remembers',
  'What the policy sees',
  'Lift-off',
];
const allLessons = async (lab) => {
  const back = lab.button('All lessons');
  if (await back.count()) await back.click();
};
const inLesson = async (lab) => {
  if (await lab.button('All lessons').count()) return;
  await lab.page.getByRole('button', { name: /^Meet the magnet/ }).click();
};
/** At its beginning, with a prediction made. */
const predicted = async (lab) => {
  await inLesson(lab);
  while (await lab.button('Back').isEnabled()) await lab.button('Back').click();
  await lab.page.getByRole('radio', { name: 'Right below the magnet' }).check();
};
const atRun = async (lab) => {
  await predicted(lab);
  await lab.button('Next').click();
};

export const PAST = [
  {
    rowReady: open('Share'),
    rows: {
      'textbox Link to this experiment': {
        see: (_lab, locator) => locator.evaluate((one) => one.selectionEnd - one.selectionStart),
      },
      'button Copy': { see: (lab) => lab.page.locator('.share-done').innerText() },
    },
    after: (lab) => lab.page.keyboard.press('Escape'),
  },
  {
    ready: async (lab) => {
      // Each goal is an event: some before the one that is looked into, some after it.
      for (let i = 0; i < 2; i++) await anotherGoal(lab);
      await withHistory(lab);
      await tab('Events')(lab);
    },
    rows: {
      // In the toolbar of the timeline.
      'button /^(?!Why)[A-Z][a-z -]* at \\d/': { see: dialogs, after: close },
      'button /^Why: /': { see: dialogs, after: close },
      'link Keep as test case': { see: (lab) => lab.downloads },
      'button Previous event': { see: title, ready: inspect, after: close },
      'button Next event': { see: title, ready: inspect, after: close },
      'button Close': { see: dialogs, ready: inspect },
      'button Go there': {
        see: (lab) => lab.sent.rewind?.tick ?? -1,
        ready: async (lab) => {
          lab.sent.rewind = undefined;
          await inspect(lab);
        },
        after: close,
      },
      'button Compare controllers from here': {
        see: (lab) => JSON.stringify(lab.sent.fork ?? null),
        ready: async (lab) => {
          lab.sent.fork = undefined;
          await inspect(lab);
        },
        after: ghosts,
      },
    },
    after: withoutGhosts,
  },
  {
    ready: async (lab) => {
      await pause(lab);
      await tab('Compare')(lab);
    },
    rows: {
      'checkbox Compare RL': { see: isChecked, isToggle: true },
      'checkbox Compare ERRT': { see: isChecked, isToggle: true },
      'checkbox Compare Attractor': { see: isChecked, isToggle: true },
      'button Compare from here': {
        see: compared,
        ready: async (lab) => {
          await anotherGoal(lab);
          lab.sent.fork = undefined;
        },
        // Their goal is near: those that are played below have a longer way.
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
      'button Clear ghosts': {
        see: (lab) => lab.button('Clear ghosts').count(),
        ready: withGhosts,
      },
    },
    after: tab('Plots'),
  },
  {
    ready: tab('Lessons'),
    rows: {
      ...Object.fromEntries(
        LESSONS.map((name) => [`button /^${name} /`, { see: heading, after: allLessons }]),
      ),
      'radio /^(Right below the|A little behind|Far behind)/': { see: isChecked, ready: inLesson },
      'button Next': { see: step, ready: predicted },
      'button Back': { see: step, ready: atRun },
      'button Set it up': { see: (lab) => lab.scene.trial, ready: atRun },
      'button Set it up again': { see: (lab) => lab.scene.trial },
      'button All lessons': { see: heading, ready: inLesson },
      'button Start over': { see: (lab) => lab.button('Start over').isDisabled() },
    },
    after: async (lab) => {
      await allLessons(lab);
      await tab('Events')(lab);
      await lab.page.getByLabel('Map', { exact: true }).selectOption('posts');
      await until('posts', () => lab.scene.map === 'posts');
    },
  },
];
