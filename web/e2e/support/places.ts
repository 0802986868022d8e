// The places of the page: views, tabs, what buttons and summaries open, each controller, and the moments in which the
// page looks different. Places are found, not listed: a new tab is looked at without a change here.

import { type Locator, type Page, expect } from '@playwright/test';
import type { Lab } from './lab';
import { inSpace } from './moments';
import { must, until } from './wait';

/** Ticks of history, so that there are moments to go back to. */
const HISTORY_TICKS = 250;

export interface Place {
  readonly name: string;
  /** The panel that it is in, for a picture. */
  readonly panel: Locator;
  /** What was pressed to get there. */
  readonly opener?: Locator;
}

export type Places = (lab: Lab) => AsyncGenerator<Place>;

export const slug = (text: string) => text.toLowerCase().replaceAll(/\W+/g, '-');

/** Opens everything that folds. */
async function unfold(page: Page) {
  await page.evaluate(() => {
    for (const one of document.querySelectorAll('details')) one.open = true;
  });
}

/** A goal is placed, time has passed, and the session is paused. */
export async function settle(lab: Lab) {
  await lab.reset({ speed: '8' });
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.3)[0]);
  await lab.run();
  await until('a history', () => lab.state.newest_tick > HISTORY_TICKS);
  await lab.pause();
  await unfold(lab.page);
}

/** The panel or bar that something is in. */
const panelOf = (locator: Locator) =>
  locator.locator('xpath=(ancestor::section | ancestor::*[contains(@class, "bar ")])[last()]');

async function* popovers(page: Page, scope: Locator, within: string): AsyncGenerator<Place> {
  const closed = scope.locator('button[aria-expanded=false]:enabled:visible');
  const names = await closed.evaluateAll((all) =>
    all.map((one) => one.getAttribute('aria-label') ?? one.textContent.trim()),
  );
  for (const name of names) {
    const opener = scope.getByRole('button', { name, exact: true }).first();
    const isOpen = async () => (await opener.getAttribute('aria-expanded')) === 'true';
    await opener.click();
    await unfold(page);
    yield { name: `${within}: ${name}`, panel: panelOf(opener), opener };
    // The Tab key may have closed it.
    if (await isOpen()) await page.keyboard.press('Escape');
    if (await isOpen()) await opener.click();
  }
}

/** A view, and what its buttons open. */
export const view = (name: string): Places =>
  async function* (lab) {
    const opener = lab.view(name);
    await opener.click();
    await lab.drawn();
    await unfold(lab.page);
    yield { name, panel: lab.page.locator('main'), opener };
    yield* popovers(lab.page, lab.page.locator('body'), name);
  };

/** The tabs of a list, and what buttons open in them. */
export const tabs = (area: string): Places =>
  async function* ({ page }) {
    const list = page.locator(`.${area}`).getByRole('tablist');
    const all = await list.getByRole('tab').all();
    expect(all.length, `tabs in ${area}`).toBeGreaterThan(1);
    for (const tab of all) {
      const name = await tab.innerText();
      await tab.click();
      await unfold(page);
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
    await unfold(page);
    yield { name: `controller ${value}`, panel: page.locator('section.panel.controller') };
  }
};

/** What a person may come upon. */
export const moments: Places = async function* (lab) {
  const { page } = lab;
  await lab.click(lab.wallPoint());
  await lab.notice('workspace').waitFor();
  yield { name: 'refusal', panel: page.locator('section.panel.workspace') };
  await lab.button('Keyboard shortcuts').click();
  await page.getByRole('dialog').waitFor();
  yield { name: 'keyboard', panel: page.getByRole('dialog') };
  await page.keyboard.press('Escape');
  await lab.run();
  yield { name: 'running', panel: page.locator('footer.bar') };
  await lab.pause();
  await lab.releaseControl();
  yield { name: 'viewer', panel: page.locator('header.bar') };
};

export const space: Places = async function* (lab) {
  await inSpace(lab);
  yield { name: '3-D', panel: lab.page.locator('section.panel.workspace') };
};
