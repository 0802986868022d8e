// Each place of the page in both themes: axe, names, sizes, the Tab order, and a picture of each panel in test-output.

import { fileURLToPath } from 'node:url';
import type { Locator } from '@playwright/test';
import { isKnown } from './controls/table';
import { type Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { DESKTOP, TABLET } from './support/browser';
import { LEAST_PX, controls, faultsOf, unreached } from './support/inventory';
import {
  type Place,
  type Places,
  controllers,
  moments,
  settle,
  slug,
  space,
  tabs,
  view,
} from './support/places';

const THEMES = ['dark', 'light'] as const;
const VIEWS = ['Laboratory', 'Recordings', 'Evaluate'];
const TAB_AREAS = ['lower', 'aside'];
const PICTURES = fileURLToPath(new URL('../../test-output/', import.meta.url));

const PLACES: Record<string, Places> = {
  ...Object.fromEntries(VIEWS.map((name) => [`the view ${name}`, view(name)])),
  ...Object.fromEntries(TAB_AREAS.map((area) => [`the tabs ${area}`, tabs(area)])),
  'each controller': controllers,
  'refusals, help and roles': moments,
  'the 3-D view': space,
};

/** A picture of a panel from its top. */
async function shoot(panel: Locator, name: string) {
  await panel.evaluate((part) => {
    for (const one of part.querySelectorAll('*')) one.scrollTop = 0;
  });
  await panel.screenshot({ path: `${PICTURES}panel-${name}.png` });
}

async function shootAll(lab: Lab, place: Place, theme: string) {
  if (!VIEWS.includes(place.name)) {
    await shoot(place.panel, `${slug(place.name)}-${theme}`);
    return;
  }
  for (const panel of await place.panel.locator('section.panel').all()) {
    const label = await panel.getAttribute('aria-label');
    const [, name = slug(label ?? 'panel')] = ((await panel.getAttribute('class')) ?? '').split(
      ' ',
    );
    await shoot(panel, `${name}-${theme}`);
  }
  await lab.page.screenshot({ path: `${PICTURES}web-${slug(place.name)}-${theme}.png` });
}

for (const [device, options] of Object.entries({ desktop: DESKTOP, tablet: TABLET })) {
  const isTouch = device === 'tablet';

  test.describe(device, () => {
    test.use(options);

    for (const [where, places] of Object.entries(PLACES)) {
      const isView = where.startsWith('the view');

      test(`${where}: names, sizes, Tab order and contrast are right on a ${device}`, async ({
        lab,
      }) => {
        const faults = new Set<string>();
        const known = new Set<string>();
        await settle(lab);
        // The test of a view has all of it; the others only what they open.
        if (!isView) for (const { key } of await controls(lab.page)) known.add(key);
        for await (const place of places(lab)) {
          for (const colorScheme of THEMES) {
            await lab.page.emulateMedia({ colorScheme });
            for (const one of await violations(lab.page)) faults.add(`${place.name}, ${one}`);
            if (!isTouch) await shootAll(lab, place, colorScheme);
          }
          const all = await controls(lab.page);
          for (const fault of faultsOf(all, isTouch ? LEAST_PX.touch : LEAST_PX.mouse)) {
            faults.add(fault);
          }
          const fresh = all.filter(({ key }) => !known.has(key));
          for (const one of fresh) {
            known.add(one.key);
            if (!isKnown(one)) faults.add(`no row of e2e/controls knows “${one.key}”`);
          }
          for (const fault of await unreached(lab.page, all, fresh, place.opener)) {
            faults.add(fault);
          }
        }
        expect([...faults]).toEqual([]);
      });
    }
  });
}

test('no view and no list of tabs is left out above', async ({ lab }) => {
  const views = lab.page.getByRole('navigation', { name: 'Views' }).getByRole('button');
  await expect(views).toHaveText(VIEWS);
  for (const name of VIEWS) {
    await lab.view(name).click();
    await lab.drawn();
    await expect(lab.page.getByRole('tablist')).toHaveCount(
      name === 'Laboratory' ? TAB_AREAS.length : 0,
    );
  }
});

for (const [name, width, height] of [
  ['wide', 1440, 900],
  ['small', 1280, 800],
  ['tablet', 820, 1180],
] as const) {
  test(`takes pictures of a ${name} page`, async ({ lab }) => {
    await lab.page.setViewportSize({ width, height });
    await lab.reset({ speed: '8' });
    await lab.setGoal(lab.freePoints(await lab.bead(), 0.2, 0.4)[0]);
    await lab.run();
    await lab.later(400);
    await lab.pause();
    for (const colorScheme of THEMES) {
      await lab.page.emulateMedia({ colorScheme });
      await lab.drawn();
      await lab.page.screenshot({ path: `${PICTURES}web-${name}-${colorScheme}.png` });
    }
    const isWider = () =>
      lab.page.evaluate(() => document.documentElement.scrollWidth > window.innerWidth);
    expect(await isWider(), 'the page scrolls sideways').toBe(false);
  });
}
