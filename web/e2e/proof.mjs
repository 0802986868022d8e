// Every place of the page looked at, and every control of it worked, by each hand.

import { violations } from './axe.mjs';
import { isKnown, workAll } from './drive.mjs';
import { Keys, Mouse, Touch } from './hands.mjs';
import { check, until } from './harness.mjs';
import { LEAST_PX, controls, faultsOf, unreached } from './inventory.mjs';
import { Lab } from './lab.mjs';
import { places, slug } from './tour.mjs';

const THEMES = ['dark', 'light'];

export const DESKTOP = { viewport: { width: 1280, height: 800 } };
export const TABLET = { viewport: { width: 820, height: 1180 }, hasTouch: true };

/** Runs `work` with another page as the operator, which has chosen no colours yet. */
export async function withPage({ lab, browser, server }, options, work) {
  await lab.button('Release control').click();
  await lab.button('Take control').waitFor();
  const other = await Lab.open(browser, server.url, options);
  try {
    await until('the operator', async () => (await other.text('role')) === 'operator');
    await work(other);
  } finally {
    await other.page.context().close();
    await lab.button('Take control').click();
    await lab.button('Release control').waitFor();
  }
}

const tell = (faults) => check(faults.size === 0, [...faults].join('\n      '));

/** One picture of each panel, by the first place that shows it. */
async function shoot(lab, place, theme) {
  if (!place.isView) {
    await lab.shoot(place.panel, `panel-${slug(place.name)}-${theme}`);
    return;
  }
  const panels = place.panel.locator('section.panel');
  for (const panel of await panels.all()) {
    const label = await panel.getAttribute('aria-label');
    const [, name = slug(label ?? 'panel')] = (await panel.getAttribute('class')).split(' ');
    await lab.shoot(panel, `panel-${name}-${theme}`);
  }
  await lab.screenshot(`${slug(place.name)}-${theme}`);
}

/** Names, sizes and the way by Tab of all controls, and axe on every place, dark and light. */
async function looksAt(context, options) {
  const leastPx = options.hasTouch ? LEAST_PX.touch : LEAST_PX.mouse;
  const faults = new Set();
  const known = new Set();
  await withPage(context, options, async (lab) => {
    for await (const place of places(lab)) {
      for (const colorScheme of THEMES) {
        await lab.page.emulateMedia({ colorScheme });
        for (const one of await violations(lab.page)) faults.add(`${place.name}, ${one}`);
        if (!options.hasTouch) await shoot(lab, place, colorScheme);
      }
      const all = await controls(lab.page);
      for (const fault of faultsOf(all, leastPx)) faults.add(fault);
      const fresh = all.filter(({ key }) => !known.has(key));
      for (const one of fresh) {
        known.add(one.key);
        if (!isKnown(one)) faults.add(`no row of controls.mjs knows “${one.key}” of ${place.name}`);
      }
      for (const fault of await unreached(lab.page, all, fresh, place.opener)) faults.add(fault);
    }
  });
  tell(faults);
}

async function worksBy(context, Hand, options) {
  await withPage(context, options, async (lab) => {
    await lab.reset();
    tell(new Set(await workAll(new Hand(lab))));
  });
}

export const PROOF = [
  ['has names, sizes, Tab order and contrast at 1280×800', (all) => looksAt(all, DESKTOP)],
  ['has names, sizes, Tab order and contrast on a tablet', (all) => looksAt(all, TABLET)],
  ['does by mouse what each control says', (all) => worksBy(all, Mouse, DESKTOP)],
  ['does by keyboard what each control says', (all) => worksBy(all, Keys, DESKTOP)],
  ['does by touch what each control says', (all) => worksBy(all, Touch, TABLET)],
];
