// Every place of the page, found as a stranger would find them: views, tabs, what buttons and
// summaries open, each controller, and the moments in which the page looks different.

import { until } from './harness.mjs';
import { inSpace } from './moments.mjs';

/** Ticks to have behind, so that there is a way back. */
const HISTORY_TICKS = 250;

export const slug = (text) => text.toLowerCase().replaceAll(/\W+/g, '-');

/** Opens what folds, everywhere. */
async function unfold(page) {
  await page.evaluate(() => {
    for (const one of document.querySelectorAll('details')) one.open = true;
  });
}

/** A goal is placed, time has passed and stands. */
async function settle(lab) {
  await lab.reset({ speed: '8' });
  await lab.click(lab.freePoints(await lab.point('bead'), 0.1, 0.3)[0]);
  await until('a goal', () => lab.state.goal_m);
  await lab.run();
  await until('a history', () => lab.state.newest_tick > HISTORY_TICKS);
  await lab.pause();
}

/** The panel or bar that something is in. */
const panelOf = (locator) =>
  locator.locator('xpath=(ancestor::section | ancestor::*[contains(@class, "bar ")])[last()]');

async function* popovers(page, scope, within) {
  const closed = scope.locator('button[aria-expanded=false]:enabled:visible');
  const names = await closed.evaluateAll((all) =>
    all.map((one) => one.getAttribute('aria-label') ?? one.textContent.trim()),
  );
  for (const name of names) {
    const opener = scope.getByRole('button', { name, exact: true }).first();
    await opener.click();
    await unfold(page);
    yield { name: `${within}: ${name}`, panel: panelOf(opener), opener };
    // Going on by Tab may have closed it.
    if ((await opener.getAttribute('aria-expanded')) === 'true')
      await page.keyboard.press('Escape');
    if ((await opener.getAttribute('aria-expanded')) === 'true') await opener.click();
  }
}

async function* tabs(page) {
  for (const list of await page.getByRole('tablist').all()) {
    for (const tab of await list.getByRole('tab').all()) {
      const name = await tab.innerText();
      await tab.click();
      await unfold(page);
      const content = page.locator(`[id="${await tab.getAttribute('aria-controls')}"]`);
      yield { name, panel: panelOf(tab), opener: tab };
      yield* popovers(page, content, name);
    }
    await list.getByRole('tab').first().click();
  }
}

async function* controllers(lab) {
  const { page } = lab;
  for (const radio of await page
    .getByRole('radiogroup', { name: 'Controller' })
    .getByRole('radio')
    .all()) {
    const value = await radio.getAttribute('value');
    await radio.check();
    await until(value, () => lab.state.controller === value);
    await lab.button('Step').click();
    await unfold(page);
    yield { name: `controller ${value}`, panel: page.locator('section.panel.controller') };
  }
}

async function* moments(lab) {
  const { page } = lab;
  await lab.click(lab.wallPoint());
  await lab.notice('workspace').waitFor();
  yield { name: 'refusal', panel: page.locator('section.panel.workspace') };
  await page.getByRole('radio', { name: '3-D', exact: true }).check();
  await inSpace(lab);
  yield { name: '3-D', panel: page.locator('section.panel.workspace') };
  await page.getByRole('radio', { name: 'Plan', exact: true }).check();
  await lab.button('Keyboard shortcuts').click();
  await page.getByRole('dialog').waitFor();
  yield { name: 'keyboard', panel: page.getByRole('dialog') };
  await page.keyboard.press('Escape');
  await lab.run();
  await until('running', () => lab.state.running);
  yield { name: 'running', panel: page.locator('footer.bar') };
  await lab.pause();
  await lab.button('Release control').click();
  await lab.button('Take control').waitFor();
  yield { name: 'viewer', panel: page.locator('header.bar') };
  await lab.button('Take control').click();
  await lab.button('Release control').waitFor();
}

/**
 * Goes to each place of an operator's page. Each comes with a name, the panel that it is in, and
 * what was pressed to get there.
 */
export async function* places(lab) {
  const { page } = lab;
  await settle(lab);
  const views = page.getByRole('navigation', { name: 'Views' }).getByRole('button');
  for (const view of await views.all()) {
    const name = await view.innerText();
    await view.click();
    await lab.drawn();
    await unfold(page);
    yield { name, panel: page.locator('main'), opener: view, isView: true };
    yield* popovers(page, page.locator('body'), name);
    yield* tabs(page);
    if (name === 'Laboratory') {
      yield* controllers(lab);
      yield* moments(lab);
    }
  }
  await views.first().click();
}
