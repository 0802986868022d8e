// Contrast, names, sizes, legibility and Tab order of every view, panel and popover in both themes.
// Saves a picture of each panel in test-output.

import { fileURLToPath } from 'node:url';
import type { Locator } from '@playwright/test';
import { hasRow } from './controls/table';
import { DAILY, LONG, type Lab, expect, test } from './fixtures';
import { violations } from './support/axe';
import { DESKTOP, PHONE, TABLET } from './support/browser';
import { MIN_SIDE_PX, controls, faultsOf, unreached } from './support/inventory';
import { atRest, illegible } from './support/legible';
import {
  type Place,
  type Places,
  challenge,
  controllers,
  inTurn,
  panels,
  phone,
  plots,
  prepare,
  refusalsHelpAndRoles,
  results,
  sceneView,
  slug,
  view,
} from './support/places';

/** Colours are all that a theme changes, so the second one is only checked for contrast. */
const RULES_BY_THEME = { dark: undefined, light: ['color-contrast', 'link-in-text-block'] };
const THEMES = ['dark', 'light'] as const;
type Theme = (typeof THEMES)[number];
const VIEWS = ['Lab', 'Draw', 'Train', 'Recordings', 'Evaluate'];
const DAILY_PLACES = ['views', 'panels'];
const DAILY_WINDOW = 'small';
const RECORDINGS = 4;
const PICTURES = fileURLToPath(new URL('../../test-output/', import.meta.url));

const PLACES: Record<string, Places> = {
  views: inTurn(VIEWS.map(view)),
  panels: inTurn([panels, plots]),
  'controllers, refusals, help and roles': inTurn([controllers, refusalsHelpAndRoles]),
  'a challenge': challenge,
  results,
  'the 3-D view': sceneView,
};

/** Saves a picture of a panel, scrolled to its top. */
async function savePicture(panel: Locator, name: string) {
  await panel.evaluate((part) => {
    for (const one of part.querySelectorAll('*')) one.scrollTop = 0;
  });
  await panel.screenshot({ path: `${PICTURES}panel-${name}.png` });
}

async function savePictures(lab: Lab, place: Place, theme: Theme) {
  if (!VIEWS.includes(place.name)) {
    await savePicture(place.panel, `${slug(place.name)}-${theme}`);
    return;
  }
  await lab.page.screenshot({ path: `${PICTURES}web-${slug(place.name)}-${theme}.png` });
}

/** What axe finds in one theme: in the whole page of a view, otherwise in the panel. */
async function inColours(lab: Lab, place: Place, theme: Theme, isView: boolean) {
  await lab.page.emulateMedia({ colorScheme: theme });
  const part = isView ? undefined : place.panel;
  const found = await violations(lab.page, RULES_BY_THEME[theme], part);
  return found.map((one) => `${place.name}, ${one}`);
}

interface Look {
  /** Of controls. */
  readonly leastPx: number;
  /** Whether axe looks at the whole page, otherwise at the panel of each place; undefined: it does not look. */
  readonly axe?: 'page' | 'panel';
  readonly hasPictures: boolean;
  /** Whether also the controls count that are there at the beginning. */
  readonly isWhole: boolean;
}

/** What is wrong at all places, in dark colours. */
async function faultsAt(lab: Lab, places: Places, look: Look) {
  const faults = new Set<string>();
  const known = new Set<string>();
  if (!look.isWhole) for (const { key } of await controls(lab.page)) known.add(key);
  for await (const place of places(lab)) {
    if (look.axe)
      for (const one of await inColours(lab, place, 'dark', look.axe === 'page')) faults.add(one);
    if (look.hasPictures) await savePictures(lab, place, 'dark');
    const all = await controls(lab.page);
    for (const fault of faultsOf(all, look.leastPx)) faults.add(fault);
    for (const fault of await illegible(lab.page)) faults.add(`${place.name}: ${fault}`);
    const added = all.filter(({ key }) => !known.has(key));
    for (const one of added) {
      known.add(one.key);
      if (!hasRow(one)) faults.add(`“${one.key}” has no row in e2e/controls`);
    }
    for (const fault of await unreached(lab.page, all, added, place.opener)) faults.add(fault);
  }
  return [...faults];
}

for (const [device, options] of Object.entries({ desktop: DESKTOP, tablet: TABLET })) {
  const isTouch = device === 'tablet';

  test.describe(device, () => {
    test.use(options);

    for (const [where, places] of Object.entries(PLACES)) {
      const isView = where === 'views';
      // A tablet has the same colours, and the same elements in each view.
      const axe = isView ? 'page' : 'panel';

      test(
        `${where}: names, sizes, text, Tab order and contrast are right on a ${device}`,
        !isTouch && DAILY_PLACES.includes(where) ? DAILY : LONG,
        async ({ lab }) => {
          await prepare(lab);
          const faults = await faultsAt(lab, places, {
            leastPx: isTouch ? MIN_SIDE_PX.touch : MIN_SIDE_PX.mouse,
            ...(!isTouch || isView ? { axe } : {}),
            hasPictures: !isTouch,
            isWhole: isView,
          });
          expect(faults).toEqual([]);
        },
      );

      if (isTouch) continue;
      test(`${where}: contrast is right in light colours`, LONG, async ({ lab }) => {
        const faults = new Set<string>();
        await prepare(lab);
        for await (const place of places(lab)) {
          for (const one of await inColours(lab, place, 'light', isView)) faults.add(one);
          // The panels of the views show the light colours.
          if (isView) await savePictures(lab, place, 'light');
        }
        expect([...faults]).toEqual([]);
      });
    }
  });
}

test.describe('phone', () => {
  test.use({ ...PHONE, hasTouch: true });

  test(
    'names, sizes, text and Tab order are right on a phone',
    LONG,
    async ({ lab, openLab, newSession }) => {
      const leastPx = MIN_SIDE_PX.touch;
      // More recordings than the list has room for.
      for (let i = 0; i < RECORDINGS; i++) await openLab({ url: newSession().url });
      const faults = await faultsAt(lab, phone, {
        leastPx,
        axe: 'page',
        hasPictures: false,
        isWhole: true,
      });
      expect(faults).toEqual([]);
    },
  );
});

test('the tests above cover every view, and each view has no other tabs', async ({ lab }) => {
  const views = lab.page.getByRole('navigation', { name: 'Views' }).getByRole('link');
  await expect(views).toHaveText(VIEWS);
  for (const name of VIEWS) {
    await lab.view(name).click();
    await lab.drawn();
    await expect(lab.page.getByRole('tablist')).toHaveCount(name === 'Lab' ? 1 : 0);
  }
});

for (const [name, width, height] of [
  ['wide', 1440, 900],
  ['small', 1280, 800],
  ['tablet', 820, 1180],
] as const) {
  const suite = name === DAILY_WINDOW ? DAILY : LONG;
  test(`fits into a ${name} window, and saves its pictures`, suite, async ({ lab }) => {
    await lab.page.setViewportSize({ width, height });
    await lab.reset();
    await lab.setGoal(lab.freePoints(await lab.bead(), 0.2, 0.4)[0]);
    await lab.step(400);
    for (const colorScheme of THEMES) {
      await lab.page.emulateMedia({ colorScheme });
      await lab.drawn();
      await atRest(lab.page);
      await lab.page.screenshot({ path: `${PICTURES}web-${name}-${colorScheme}.png` });
    }
    const isWider = () =>
      lab.page.evaluate(() => document.documentElement.scrollWidth > window.innerWidth);
    expect(await isWider(), 'the page scrolls horizontally').toBe(false);
  });
}
