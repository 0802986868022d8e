// Does every lesson to its end: its experiments must confirm its claim.

import { DAILY, LONG, Lab, expect, test } from './fixtures';
import { TRAIN_MS, clearTrainings } from './support/trainings';
import { until } from './support/wait';

/** The cheapest lessons. */
const DAILY_LESSONS: readonly string[] = ['Lose the bead', 'What ERRT remembers'];

interface Lesson {
  readonly title: string;
  /** The right prediction. */
  readonly choice: string;
  readonly runs: number;
  /** The button to press in the first run, and the task after which to press it. */
  readonly action?: { readonly button: string; readonly after: string };
}

const LESSONS: readonly Lesson[] = [
  {
    title: 'Lose the bead',
    choice: 'It flies straight to the bead',
    runs: 1,
    action: { button: 'Take it away for me', after: 'The simulation runs' },
  },
  {
    title: 'The threshold T',
    choice: 'It is fetched more often and arrives later',
    runs: 2,
  },
  { title: 'The law to the letter', choice: 'The two take turns', runs: 2 },
  { title: 'Why the attractor gets stuck', choice: 'Up to the wall', runs: 2 },
  {
    title: 'What ERRT remembers',
    choice: 'Once',
    runs: 1,
    action: { button: 'Send it back', after: 'Delivered to the goal' },
  },
  { title: 'What the policy sees', choice: 'It loses its way', runs: 2 },
  {
    title: 'Lift-off',
    choice: 'Soon',
    runs: 2,
    action: { button: 'Lower by 2 mm', after: 'The simulation runs' },
  },
  { title: 'The gut moves', choice: 'It delivers the bead about as fast as before', runs: 3 },
];
const FIRST = {
  title: /^Meet the magnet/i,
  choices: [/^Right below/i, /^A little behind/i],
  task: /carried for 10 cm/i,
} as const;
const VIEWER_LESSON = { title: /^Lose the bead/i, choice: /^It stops until the bead is back/i };
const WATCHING = /You are watching: take control/i;

const tasksOf = (lab: Lab) => lab.page.locator('.lesson-tasks li.done');

async function next(lab: Lab) {
  await lab.button('Next').click();
}

async function setUp(lab: Lab, press: () => Promise<unknown>) {
  const { trial } = lab.scene;
  await press();
  await until('another trial', () => lab.scene.trial !== trial && lab.state.tick === 0);
  // From here on the lesson checks its tasks.
  await lab.button('Set it up again').waitFor();
}

/** Presses the button of a lesson: once, or for *Lower by 2 mm* until the task is done. */
async function act(lab: Lab, { button, after }: NonNullable<Lesson['action']>) {
  const done = tasksOf(lab).getByText(after);
  await lab.stepUntil(after, async () => (await done.count()) > 0);
  await lab.button(button).click();
  if (!button.startsWith('Lower')) return;
  while (!(await lab.button('Next').isEnabled())) {
    const height_m = lab.scene.parameters.tool_height_m;
    await lab.button(button).click();
    await until('a lower tool', () => lab.scene.parameters.tool_height_m !== height_m);
    // The change must have an effect.
    await lab.step(300);
  }
}

for (const { title, choice, runs, action } of LESSONS) {
  const suite = DAILY_LESSONS.includes(title) ? DAILY : LONG;
  test(`the experiments of the lesson “${title}” confirm its claim`, suite, async ({ lab }) => {
    await lab.panel('Learn');
    await lab.page.getByRole('button', { name: new RegExp(`^${title}`) }).click();
    await lab.page.getByRole('radio', { name: choice }).check();
    await next(lab);
    for (let run = 0; run < runs; run += 1) {
      await setUp(lab, () => lab.button('Set it up').click());
      if (run === 0 && action) await act(lab, action);
      await lab.stepUntil('the tasks', () => lab.button('Next').isEnabled());
      await next(lab);
    }
    await expect(lab.page.getByTestId('lesson-outcome')).toHaveText(new RegExp(`^${choice}`));
    await lab.button('Finish').click();
    await expect(lab.page.getByText('1 of 12 done')).toBeVisible();
    await until('the settings before the lesson', () => {
      const { parameters, defaults } = lab.scene;
      return JSON.stringify(parameters) === JSON.stringify(defaults);
    });
    await expect(lab.label('Speed')).toHaveValue('1');
    await lab.button('Start over').click();
    await expect(lab.page.getByText('0 of 12 done')).toBeVisible();
  });
}

const TRAINING_LESSONS = [
  {
    title: 'Why learning fails',
    choice: 'The one that is rewarded only at the goal',
    policies: ['lesson-no-exploration', 'lesson-no-discount', 'lesson-sparse'],
  },
  {
    title: 'How far the goal is felt',
    choice: 'The one with discount .97',
    policies: ['lesson-far', 'lesson-near'],
  },
  {
    title: 'A head start',
    choice: 'The one that begins as colon',
    policies: ['lesson-random', 'lesson-tuned'],
  },
];

for (const { title, choice, policies } of TRAINING_LESSONS) {
  test(
    `the trainings of the lesson “${title}” confirm its claim`,
    LONG,
    async ({ lab, server }) => {
      test.setTimeout(policies.length * TRAIN_MS);
      await lab.panel('Learn');
      await lab.page.getByRole('button', { name: new RegExp(`^${title}`) }).click();
      await lab.page.getByRole('radio', { name: choice }).check();
      await next(lab);
      for (const policy of policies) {
        await expect(lab.button('Next')).toBeDisabled();
        await lab.button(`Train ${policy}`).click();
        await expect(lab.button('Next')).toBeEnabled({ timeout: TRAIN_MS });
        await expect(
          lab.page.getByText(/of 1000 episodes with random starts and goals/),
        ).toBeVisible();
        await next(lab);
      }
      await expect(lab.page.getByTestId('lesson-outcome')).toHaveText(new RegExp(`^${choice}`));
      await lab.button('Finish').click();
      await expect(lab.page.getByText('1 of 12 done')).toBeVisible();
      await lab.button('Start over').click();
      await clearTrainings(lab.page.request, server.url);
    },
  );
}

test('does the first lesson by keyboard, and remembers it after a reload', async ({ lab }) => {
  const { page } = lab;
  const { keyboard } = page;
  const [first, second] = FIRST.choices;
  await lab.tab('Now').focus();
  for (let i = 0; i < 2; i++) await keyboard.press('ArrowRight');
  await page.getByRole('button', { name: FIRST.title }).focus();
  await keyboard.press('Enter');
  await expect(lab.button('Next'), 'Next without a prediction').toBeDisabled();
  await page.getByLabel(first).focus();
  await keyboard.press(' ');
  await keyboard.press('ArrowDown');
  await expect(page.getByLabel(second)).toBeChecked();
  await lab.button('Next').press('Enter');
  await setUp(lab, () => lab.button('Set it up').press('Enter'));
  expect(lab.scene.map).toBe('open');
  await until('the goal of the lesson', () => lab.state.goal_m);
  await lab.stepUntil('the tasks', () => lab.button('Next').isEnabled());
  await expect(tasksOf(lab).getByText(FIRST.task)).toBeVisible();
  await lab.button('Next').press('Enter');
  await expect(page.getByTestId('lesson-outcome')).toHaveText(second);
  await lab.button('Finish').press('Enter');
  await expect(page.getByText('1 of 12 done')).toBeVisible();

  await page.reload();
  await lab.live();
  await lab.panel('Learn');
  await expect(page.getByText('1 of 12 done')).toBeVisible();
  await page.getByRole('button', { name: FIRST.title }).click();
  await expect(page.getByLabel(second)).toBeChecked();
  for (let i = 0; i < 2; i++) await lab.button('Next').press('Enter');
  await lab.button('Next lesson').press('Enter');
  await expect(page.getByRole('heading', { name: 'Lift-off' })).toBeVisible();
});

test('the link of a lesson opens it in a session of the pupil’s own', async ({
  lab,
  browser,
  server,
}) => {
  await lab.panel('Learn');
  await lab.button('Link to Lose the bead').click();
  const link = await lab.page.getByLabel('Link: Lesson Lose the bead').inputValue();
  await lab.page.getByRole('button', { name: VIEWER_LESSON.title }).click();
  await lab.button('Share').click();
  await expect(lab.page.getByLabel('Link: This lesson')).toHaveValue(link);
  // A browser that has never been here.
  const context = await browser.newContext();
  const page = await context.newPage();
  const pupil = new Lab(page);
  await page.goto(link);
  await page.getByRole('button', { name: 'Open it' }).click();
  await pupil.live();
  await pupil.isRole('operator');
  await expect(page.getByRole('heading', { name: 'Lose the bead' })).toBeVisible();
  expect(pupil.hello.session).not.toBe(lab.hello.session);
  await pupil.button('All lessons').click();
  await expect(page.getByText('0 of 12 done')).toBeVisible();
  await context.close();
  await fetch(`${server.url}/api/sessions/${pupil.hello.session}`, { method: 'DELETE' });
});

test('allows a viewer to predict, but not to set up a run', async ({ lab, openLab }) => {
  const viewer = await openLab();
  await viewer.panel('Learn');
  await viewer.page.getByRole('button', { name: VIEWER_LESSON.title }).click();
  await viewer.page.getByLabel(VIEWER_LESSON.choice).check();
  await next(viewer);
  await expect(viewer.button('Set it up')).toBeDisabled();
  await expect(viewer.page.getByText(WATCHING)).toBeVisible();
  await lab.isRole('operator');
});
