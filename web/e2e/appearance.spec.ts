// Contrast, names, sizes and Tab order of every view, tab and popover in both themes.
// Saves a picture of each panel in test-output.

import { fileURLToPath } from 'node:url';
import type { Locator } from '@playwright/test';
import { hasRow } from './controls/table';
import { LONG, type Lab, expect, longUnless, test } from './fixtures';
import { violations } from './support/axe';
import { DESKTOP, TABLET } from './support/browser';
import { MIN_SIDE_PX, controls, faultsOf, unreached } from './support/inventory';
import {
  type Place,
  type Places,
  challenge,
  controllers,
  inTurn,
  prepare,
  refusalsHelpAndRoles,
  sceneView,
  slug,
  tabs,
  view,
} from './support/places';

/** Colours are all that a theme changes, so the second one is only checked for contrast. */
const RULES_BY_THEME = { dark: undefined, light: ['color-contrast', 'link-in-text-block'] };
const DARK = ['dark'] as const;
const LIGHT = ['light'] as const;
const THEMES = [...DARK, 'light'] as const;
const VIEWS = ['Laboratory', 'Draw', 'Train', 'Recordings', 'Evaluate'];
const TAB_AREAS = ['lower', 'aside'];
const PICTURES = fileURLToPath(new URL('../../test-output/', import.meta.url));

const PLACES: Record<string, Places> = {
  views: inTurn(VIEWS.map(view)),
  tabs: inTurn(TAB_AREAS.map(tabs)),
  'controllers, refusals, help and roles': inTurn([controllers, refusalsHelpAndRoles]),
  'a challenge': challenge,
  'the 3-D view': sceneView,
};

/** Saves a picture of a panel, scrolled to its top. */
async function savePicture(panel: Locator, name: string) {
  await panel.evaluate((part) => {
    for (const one of part.querySelectorAll('*')) one.scrollTop = 0;
  });
  await panel.screenshot({ path: `${PICTURES}panel-${name}.png` });
}

async function savePictures(lab: Lab, place: Place, theme: string) {
  if (!VIEWS.includes(place.name)) {
    await savePicture(place.panel, `${slug(place.name)}-${theme}`);
    return;
  }
  for (const panel of await place.panel.locator('section.panel').all()) {
    const label = await panel.getAttribute('aria-label');
    const [, name = slug(label ?? 'panel')] = ((await panel.getAttribute('class')) ?? '').split(
      ' ',
    );
    await savePicture(panel, `${name}-${theme}`);
  }
  await lab.page.screenshot({ path: `${PICTURES}web-${slug(place.name)}-${theme}.png` });
}

interface Crawl {
  readonly isTouch: boolean;
  readonly isView: boolean;
  readonly themes: readonly ('dark' | 'light')[];
}

async function crawl(lab: Lab, places: Places, { isTouch, isView, themes }: Crawl) {
  const faults = new Set<string>();
  const known = new Set<string>();
  await prepare(lab);
  // The test of the views checks the whole page, the other tests only controls that they open.
  if (!isView) for (const { key } of await controls(lab.page)) known.add(key);
  for await (const place of places(lab)) {
    // A tablet has the same colours, and the same elements in each view.
    for (const colorScheme of !isTouch ? themes : isView ? DARK : []) {
      await lab.page.emulateMedia({ colorScheme });
      for (const one of await violations(lab.page, RULES_BY_THEME[colorScheme]))
        faults.add(`${place.name}, ${one}`);
      // The panels of the views show the light colours.
      if (!isTouch && (isView || colorScheme === 'dark'))
        await savePictures(lab, place, colorScheme);
    }
    const all = await controls(lab.page);
    for (const fault of faultsOf(all, isTouch ? MIN_SIDE_PX.touch : MIN_SIDE_PX.mouse)) {
      faults.add(fault);
    }
    const added = all.filter(({ key }) => !known.has(key));
    for (const one of added) {
      known.add(one.key);
      if (!hasRow(one)) faults.add(`“${one.key}” has no row in e2e/controls`);
    }
    for (const fault of await unreached(lab.page, all, added, place.opener)) {
      faults.add(fault);
    }
  }
  expect([...faults]).toEqual([]);
}

for (const [device, options] of Object.entries({ desktop: DESKTOP, tablet: TABLET })) {
  const isTouch = device === 'tablet';

  test.describe(device, () => {
    test.use(options);

    for (const [where, places] of Object.entries(PLACES)) {
      // Every day the dark colours on a desktop, of what all visitors see.
      const isDaily = !isTouch && (where === 'views' || where === 'tabs');

      test(
        `${where}: names, sizes, Tab order and contrast are right on a ${device}`,
        longUnless(isDaily),
        async ({ lab }) => {
          await crawl(lab, places, {
            isTouch,
            isView: where === 'views',
            themes: isDaily ? DARK : THEMES,
          });
        },
      );
      if (isDaily) {
        test(`${where}: contrast is right in light colours`, LONG, async ({ lab }) => {
          await crawl(lab, places, { isTouch, isView: where === 'views', themes: LIGHT });
        });
      }
    }
  });
}

test('the tests above cover every view and every tab list', async ({ lab }) => {
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
  test(
    `fits into a ${name} window, and saves its pictures`,
    longUnless(name === 'small'),
    async ({ lab }) => {
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
      expect(await isWider(), 'the page scrolls horizontally').toBe(false);
    },
  );
}
