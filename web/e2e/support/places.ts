// Visits the places of the page: views, tabs, what buttons and summaries open, each controller,
// refusals and roles. The places are read from the page, so a new tab needs no change here.

import { type Locator, type Page, expect } from '@playwright/test';
import type { Lab } from './lab';
import { openSceneView } from './preconditions';
import { must, until } from './wait';

/** So that the timeline has a history. */
const HISTORY_TICKS = 250;

export interface Place {
  readonly name: string;
  /** The panel to take a picture of. */
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

/** Opens all `details` elements. */
async function openDetails(page: Page) {
  await page.evaluate(() => {
    for (const one of document.querySelectorAll('details')) one.open = true;
  });
}

/** Sets a goal, and steps until there is a history. */
export async function prepare(lab: Lab) {
  await lab.reset();
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
  await lab.step(HISTORY_TICKS);
  await openDetails(lab.page);
}

/** The panel or bar that contains an element. */
const panelOf = (locator: Locator) =>
  locator.locator('xpath=(ancestor::section | ancestor::*[contains(@class, "bar ")])[last()]');

/** Opens each button of `scope` that opens something, one at a time. */
async function* popovers(page: Page, scope: Locator, within: string): AsyncGenerator<Place> {
  const closed = scope.locator('button[aria-expanded=false]:enabled:visible');
  const names = await closed.evaluateAll((all) =>
    all.map((one) => one.getAttribute('aria-label') ?? one.textContent.trim()),
  );
  // All help of fields is one component.
  const isHelp = (name: string) => name.startsWith('Help: ');
  const help = names.filter(isHelp).slice(0, 1);
  for (const name of [...names.filter((one) => !isHelp(one)), ...help]) {
    const opener = scope.getByRole('button', { name, exact: true }).first();
    const isOpen = async () => (await opener.getAttribute('aria-expanded')) === 'true';
    await opener.click();
    await openDetails(page);
    yield { name: `${within}: ${name}`, panel: panelOf(opener), opener };
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

/** Each tab of a tab list, and each part that buttons open in it. */
export const tabs = (area: string): Places =>
  async function* ({ page }) {
    const list = page.locator(`.${area}`).getByRole('tablist');
    const all = await list.getByRole('tab').all();
    expect(all.length, `tabs in ${area}`).toBeGreaterThan(1);
    for (const tab of all) {
      const name = await tab.innerText();
      await tab.click();
      await openDetails(page);
      const content = page.locator(`[id="${must(await tab.getAttribute('aria-controls'), name)}"]`);
      yield { name, panel: panelOf(tab), opener: tab };
      yield* popovers(page, content, name);
    }
  };

export const controllers: Places = async function* (lab) {
  const { page } = lab;
  const group = page.getByRole('radiogroup', { name: 'Controller' });
  for (const radio of await group.getByRole('radio').all()) {
    const value = must(await radio.getAttribute('value'), 'a controller');
    await radio.check();
    await until(value, () => lab.state.controller === value);
    await lab.button('Step').click();
    await openDetails(page);
    yield { name: `controller ${value}`, panel: page.locator('section.panel.controller') };
  }
};

/** A refusal, the help, a running session, and the page of a viewer. */
export const refusalsHelpAndRoles: Places = async function* (lab) {
  const { page } = lab;
  // With You, a press steers and sets no goal.
  await lab.controller('RL');
  await lab.click(lab.wallPoint());
  await lab.notice('workspace').waitFor();
  yield { name: 'refusal', panel: page.locator('section.panel.workspace') };
  await lab.button('Help').click();
  await page.getByRole('dialog').waitFor();
  yield { name: 'keyboard', panel: page.getByRole('dialog') };
  await page.keyboard.press('Escape');
  await lab.run();
  yield { name: 'running', panel: page.locator('footer.bar') };
  await lab.pause();
  await lab.releaseControl();
  yield { name: 'viewer', panel: page.locator('header.bar') };
};

/** A challenge that waits for its start, and an attempt that does not count. */
export const challenge: Places = async function* (lab) {
  await lab.panel('Play');
  await lab.page.getByRole('button', { name: /^Easy/ }).first().click();
  await until('a challenge', () => lab.scene.challenge);
  await lab.page.getByRole('table', { name: 'Scores on this challenge' }).waitFor();
  yield { name: 'challenge', panel: lab.page.locator('section.panel.lower') };
  await lab.button('Step').click();
  await until('it does not count', () => lab.state.attempt?.void);
  yield { name: 'void attempt', panel: lab.page.locator('section.panel.workspace') };
  await lab.page.getByRole('button', { name: /^(All challenges|Give up)$/ }).click();
  await until('no challenge', () => !lab.scene.challenge);
};

export const sceneView: Places = async function* (lab) {
  await openSceneView(lab);
  yield { name: '3-D', panel: lab.page.locator('section.panel.workspace') };
};
