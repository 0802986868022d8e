// Saves a picture of each state of the page in `test-output/states`, in both themes and at five window sizes, to look at
// one beside the other. `assets/screenshot.png` in the README is `pulled-wide-light.png`.

import { fileURLToPath } from 'node:url';
import { LONG, Lab, expect, test } from './fixtures';
import { DESKTOP, PHONE, TABLET } from './support/browser';
import { openLayers, openSceneView, openSetUp } from './support/preconditions';
import { isDone } from './support/recovery';
import { MORE_UPDATES, TRAIN_MS, clearTrainings, startTraining } from './support/trainings';
import { until } from './support/wait';

const WINDOWS = {
  small: DESKTOP,
  wide: { viewport: { width: 1440, height: 900 } },
  large: { viewport: { width: 1920, height: 1080 } },
  tablet: TABLET,
  phone: { ...PHONE, hasTouch: true },
};
type Window = keyof typeof WINDOWS;
const STATES = fileURLToPath(new URL('../../test-output/states/', import.meta.url));
const COLON = '#v=1&map=colon&controller=rl&seed=1&goal=-0.24,-0.27';
const POSTS = '#v=1&map=posts&controller=rl&seed=1&start=-0.2,-0.35&goal=0.2,-0.5';
const RESULT_MS = 90_000;
/** Transitions of the page are over, and slow pictures are there. */
const REST_MS = 1200;
const RUN_TICKS = 900;

const isPhone = ({ page }: Lab) => page.viewportSize()?.width === PHONE.viewport.width;

async function setUp(lab: Lab, link: string) {
  await lab.page.evaluate((hash) => {
    location.hash = hash;
  }, link);
  await until('the experiment', () => lab.state.goal_m);
}

/** Opens a panel by what the window has for that. */
async function show(lab: Lab, tab: string, panel = tab) {
  if (!isPhone(lab)) {
    await lab.tab(tab).click();
    if (panel !== tab) await lab.radio(panel).check();
    return;
  }
  const foot = lab.page.getByRole('navigation', { name: 'Panels' });
  const button = foot.getByRole('button', { name: panel, exact: true });
  if (!(await button.isVisible())) await foot.getByRole('button', { name: 'More' }).click();
  await button.click();
}

async function run(lab: Lab, ticks = RUN_TICKS) {
  await lab.run();
  await lab.later(ticks);
}

/** What an operator does on the page of a new session. */
type Act = (lab: Lab) => Promise<unknown>;

const toView =
  (name: string): Act =>
  ({ page }) =>
    page.goto(`${page.url().replace(/#.*/, '')}/${name}`);

async function compare(lab: Lab) {
  await lab.step(RUN_TICKS);
  await show(lab, 'Test', 'Compare');
  await lab.page.getByRole('button', { name: /^Compare from/ }).click();
  await until('the comparison', () => lab.comparison?.running === false, RESULT_MS);
}

async function recovery(lab: Lab) {
  await lab.step(RUN_TICKS);
  await show(lab, 'Test', 'Recovery');
  await lab.label('Disturbance').selectOption('place');
  await lab.label('Columns').fill('12');
  await lab.label('Repeats').fill('1');
  await lab.page.getByRole('button', { name: /^Map from/ }).click();
  await isDone(lab);
}

async function challenge(lab: Lab) {
  await show(lab, 'Play');
  await lab.page.getByRole('button', { name: /^Easy/ }).first().click();
  await until('a challenge', () => lab.scene.challenge);
  if (isPhone(lab)) await lab.button('Steer').click();
  await lab.button('Start').click();
  await lab.later(200);
}

async function lesson(lab: Lab) {
  await show(lab, 'Learn');
  await lab.page.getByRole('button', { name: /^Meet the magnet/ }).click();
  await lab.page.getByRole('radio', { name: /^Right below/ }).check();
  await lab.button('Next').click();
}

/** These have a picture at every size. */
const MAIN: Record<string, Act> = {
  lab: run,
  plots: async (lab) => {
    await run(lab);
    await lab.button('Plots').click();
  },
  compare,
  recovery,
  challenge,
  lesson,
  train: async (lab) => {
    const { origin } = new URL(lab.page.url());
    await startTraining(lab.page.request, origin, 'runner', MORE_UPDATES);
    await toView('train')(lab);
    await lab.page.locator('.train-canvas[data-update]').waitFor({ timeout: TRAIN_MS });
  },
};

const OTHERS: Record<string, Act> = {
  pulled: async (lab) => {
    await lab.step(RUN_TICKS / 2);
    await lab.speed('0.25');
    const [x, y] = await lab.bead();
    await lab.startDrag([x + 0.14, y + 0.02]);
    await lab.page.keyboard.press('Space');
  },
  scene: openSceneView,
  story: async (lab) => {
    await lab.step(RUN_TICKS);
    await show(lab, 'Story');
  },
  disturb: (lab) => show(lab, 'Test', 'Disturb'),
  tune: (lab) => show(lab, 'Tune'),
  layers: openLayers,
  setup: openSetUp,
  viewer: (lab) => lab.releaseControl(),
  draw: toView('draw'),
  recordings: toView('recordings'),
  evaluate: toView('evaluate'),
};

async function save({ page }: Lab, name: string) {
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    await page.waitForTimeout(REST_MS);
    await page.screenshot({ path: `${STATES}${name}-${colorScheme}.png` });
  }
}

for (const [window, options] of Object.entries(WINDOWS) as [Window, (typeof WINDOWS)[Window]][]) {
  test.describe(`${window} pictures`, () => {
    test.use(options);
    test.setTimeout(TRAIN_MS);
    test.beforeEach(({ page }) =>
      page.addInitScript(() => {
        localStorage.setItem('ferry.panel.camera', 'closed');
      }),
    );
    test.afterEach(({ page, server }) => clearTrainings(page.request, server.url));

    test('of the first visit', LONG, async ({ openLab, page, session }) => {
      const before = await openLab();
      await setUp(before, COLON);
      await before.page.close();
      await page.goto(session.url);
      const lab = new Lab(page);
      await lab.button('Pull it away').waitFor();
      await save(lab, `first-${window}`);
    });

    const acts = { ...MAIN, ...(['small', 'wide'].includes(window) ? OTHERS : {}) };
    for (const [state, act] of Object.entries(acts)) {
      // A phone has no plots.
      if (window === 'phone' && state === 'plots') continue;
      test(`of ${state}`, LONG, async ({ lab, session }) => {
        await setUp(lab, state === 'compare' ? POSTS : COLON);
        await act(lab);
        await save(lab, `${state}-${window}`);
        expect(lab.page.url()).toContain(session.name);
      });
    }
  });
}
