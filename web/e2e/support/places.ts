// Visits the places of the page: views, panels of the inspector, what buttons and summaries open, each
// controller, refusals and roles. The places are read from the page, so a new tab needs no change here.

import { type Locator, type Page, expect } from '@playwright/test';
import type { Lab } from './lab';
import {
  ensureNoGoal,
  openLayers,
  openSceneView,
  openSetUp,
  setUpButton,
  showTabs,
} from './preconditions';
import { makeMap } from './recovery';
import { must, until } from './wait';

/** The controllers run a challenge before their scores are known. */
const GHOSTS_MS = 60_000;
/** So that the timeline has a history. */
const HISTORY_TICKS = 250;

export interface Place {
  readonly name: string;
  /** The part of the page that the place is about. */
  readonly panel: Locator;
  /** The control that was pressed to get there. */
  readonly opener?: Locator;
}

export type Places = (lab: Lab) => AsyncGenerator<Place>;

/** The places of each list, one list after the other. */
export const inTurn = (lists: readonly Places[]): Places =>
  async function* (lab) {
    for (const places of lists) yield* places(lab);
  };

export const slug = (text: string) => text.toLowerCase().replaceAll(/\W+/g, '-');

const inspector = (page: Page) => page.locator('.inspector');
const content = (page: Page) => page.locator('#inspector-panel');

/** Opens all `details` elements. */
async function openDetails(page: Page) {
  await page.evaluate(() => {
    for (const one of document.querySelectorAll('details')) one.open = true;
  });
}

/** Sets a goal, and steps until there is a history. The run before it is kept. */
export async function prepare(lab: Lab) {
  await lab.reset();
  await lab.step(1);
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
  await lab.step(HISTORY_TICKS);
  await openDetails(lab.page);
}

/** Marks the closed buttons of `scope` that open something, and returns their names. */
const markOpeners = (scope: Locator) =>
  // What the button of the experiment opens is visited as a panel.
  scope
    .locator('button[aria-expanded=false]:not(.experiment):enabled:visible')
    .evaluateAll((all) => {
      const kinds = new Set<string>();
      return all.flatMap((one, at) => {
        const name = one.getAttribute('aria-label') ?? one.textContent.trim();
        // All help of fields is one component, and so are the lines of the story.
        const kind = /^(Help: |Why: )/.exec(name)?.[0] ?? name;
        one.removeAttribute('data-opener');
        if (kinds.has(kind)) return [];
        kinds.add(kind);
        one.setAttribute('data-opener', String(at));
        return [{ name: kind === 'Why: ' ? 'why' : name.replace(/\d+$/, ''), at }];
      });
    });

/** What a button opens: what it names, otherwise the inspector with it. */
async function openedBy(opener: Locator) {
  const id = await opener.getAttribute('aria-controls');
  const page = opener.page();
  return id ? page.locator(`[id="${id}"]`) : inspector(page);
}

/** Opens each button of `scope` that opens something, one at a time. */
async function* popovers(page: Page, scope: Locator, within: string): AsyncGenerator<Place> {
  for (const { name, at } of await markOpeners(scope)) {
    const opener = scope.locator(`[data-opener="${at}"]`);
    const isOpen = async () => (await opener.getAttribute('aria-expanded')) === 'true';
    await opener.click();
    await openDetails(page);
    yield { name: `${within}: ${name}`, panel: await openedBy(opener), opener };
    // Pressing Tab may have closed it.
    if (await isOpen()) await page.keyboard.press('Escape');
    if (await isOpen()) await opener.click();
  }
}

/** A view, and each part that its buttons open. */
export const view = (name: string): Places =>
  async function* (lab) {
    const opener = lab.view(name);
    await opener.click();
    await lab.drawn();
    await openDetails(lab.page);
    yield { name, panel: lab.page.locator('main'), opener };
    yield* popovers(lab.page, lab.page.locator('body'), name);
  };

/** The map alone, each panel, and each view of a phone. */
export const phone: Places = async function* (lab) {
  const { page } = lab;
  const foot = page.getByRole('navigation', { name: 'Panels' });
  const more = foot.getByRole('button', { name: 'More' });
  const tabs = await foot.locator('> button').all();
  for (const tab of tabs) {
    await tab.click();
    await openDetails(page);
    yield { name: await tab.innerText(), panel: page.locator('#app'), opener: tab };
  }
  await more.click();
  const menu = page.locator('#more-panels');
  yield { name: 'More', panel: menu, opener: more };
  const panelNames = await menu.locator('.phone-panels button').allInnerTexts();
  const viewNames = await menu.getByRole('link').allInnerTexts();
  for (const name of panelNames) {
    await menu.getByRole('button', { name, exact: true }).click();
    await openDetails(page);
    yield { name, panel: inspector(page), opener: more };
    await more.click();
  }
  for (const name of viewNames) {
    await menu.getByRole('link', { name, exact: true }).click();
    await lab.drawn();
    await openDetails(page);
    yield { name, panel: page.locator('main'), opener: more };
    if ((await more.getAttribute('aria-expanded')) === 'false') await more.click();
  }
};

/** The menu of the plots, which is there with the lanes. */
export const plots: Places = async function* (lab) {
  const button = lab.button('Plots');
  await button.click();
  await lab.drawn();
  const lanes = lab.page.locator('.lanes');
  yield { name: 'plots', panel: lanes, opener: button };
  yield* popovers(lab.page, lanes, 'plots');
  await button.click();
};

async function* panel(lab: Lab, name: string, opener: Locator): AsyncGenerator<Place> {
  await openDetails(lab.page);
  await lab.drawn();
  yield { name, panel: inspector(lab.page), opener };
  yield* popovers(lab.page, content(lab.page), name);
}

/** Each panel of the inspector, and each part that buttons open in it. */
export const panels: Places = async function* (lab) {
  const { page } = lab;
  await showTabs(lab);
  const tabs = await page.getByRole('tablist', { name: 'Inspector' }).getByRole('tab').all();
  expect(tabs.length, 'tabs').toBeGreaterThan(1);
  for (const tab of tabs) {
    const name = await tab.innerText();
    await tab.click();
    yield* panel(lab, name, tab);
    const parts = page.getByRole('radiogroup', { name, exact: true }).getByRole('radio');
    for (const part of (await parts.all()).slice(1)) {
      await part.check();
      yield* panel(lab, `${name} ${must(await part.getAttribute('value'), 'a part')}`, part);
    }
  }
  await openLayers(lab);
  yield* panel(lab, 'Layers', lab.button('Layers'));
  await openSetUp(lab);
  yield* panel(lab, 'Set up', setUpButton(lab));
  await showTabs(lab);
};

export const controllers: Places = async function* (lab) {
  const { page } = lab;
  await showTabs(lab);
  await lab.panel('Now');
  const group = page.getByRole('radiogroup', { name: 'Controller' });
  for (const radio of await group.getByRole('radio').all()) {
    const value = must(await radio.getAttribute('value'), 'a controller');
    await radio.check();
    await until(value, () => lab.state.controller === value);
    await lab.button('Step').click();
    await openDetails(page);
    yield { name: `controller ${value}`, panel: inspector(page) };
  }
};

/** A refusal, the help, a running session, and the page of a viewer. */
export const refusalsHelpAndRoles: Places = async function* (lab) {
  const { page } = lab;
  // With You, a press steers and sets no goal.
  await lab.controller('RL');
  await lab.click(lab.wallPoint());
  await lab.notice('workspace').waitFor();
  yield { name: 'refusal', panel: page.locator('.dock') };
  await lab.button('Help').click();
  await page.getByRole('dialog').waitFor();
  yield { name: 'keyboard', panel: page.getByRole('dialog') };
  await page.keyboard.press('Escape');
  await lab.notice('workspace').getByRole('button', { name: 'Dismiss' }).click();
  // Without a goal nothing happens that would add marks to the timeline.
  await ensureNoGoal(lab);
  await lab.run();
  yield { name: 'running', panel: page.locator('.dock') };
  await lab.pause();
  await lab.releaseControl();
  yield { name: 'viewer', panel: page.locator('.top') };
};

/** A challenge that waits for its start, and an attempt that does not count. */
export const challenge: Places = async function* (lab) {
  await lab.panel('Play');
  await lab.page.getByRole('button', { name: /^Easy/ }).first().click();
  await until('a challenge', () => lab.scene.challenge);
  await lab.page
    .getByRole('table', { name: 'Scores on this challenge' })
    .waitFor({ timeout: GHOSTS_MS });
  yield { name: 'challenge', panel: inspector(lab.page) };
  await lab.button('Step').click();
  await until('it does not count', () => lab.state.attempt?.void);
  yield { name: 'void attempt', panel: lab.page.locator('main') };
  await lab.page.getByRole('button', { name: /^(All challenges|Give up)$/ }).click();
  await until('no challenge', () => !lab.scene.challenge);
};

/** Panels with results: a comparison, a recovery map, a lesson. */
export const results: Places = async function* (lab) {
  const { page } = lab;
  await showTabs(lab);
  await lab.panel('Compare');
  await page.getByRole('button', { name: /^Compare from/ }).click();
  await until('the comparison', () => lab.comparison?.running === false, GHOSTS_MS);
  await lab.drawn();
  yield { name: 'comparison', panel: inspector(page) };
  await lab.button('Clear ghosts').click();
  await makeMap(lab);
  await page.locator('[role=application] > .cell').first().click();
  await page.getByTestId('recovery-cell').waitFor();
  yield { name: 'recovery map', panel: inspector(page) };
  await lab.panel('Learn');
  await page.getByRole('button', { name: /^Meet the magnet/ }).click();
  yield { name: 'lesson: predict', panel: inspector(page) };
  await page
    .getByRole('radiogroup')
    .getByRole('radio', { name: /^Right below/ })
    .check();
  await lab.button('Next').click();
  yield { name: 'lesson: run', panel: inspector(page) };
  await lab.button('All lessons').click();
};

export const sceneView: Places = async function* (lab) {
  await openSceneView(lab);
  yield { name: '3-D', panel: lab.page.locator('main') };
};
